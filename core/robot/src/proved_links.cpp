#include <foam/robot/proved_links.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace foam::inline robot {
namespace {

constexpr const char* nothing_is_proved = "nothing is proved (guarantee: fitted)";

std::string links_text(std::size_t proved, std::size_t all) {
    return fmt::format("{} of {}", proved, counted(all, "link"));
}

/// Returns a sentence about links that have no geometry to be covered, but another; empty if there are none.
std::string only_text(const std::vector<std::string>& links, const char* geometry) {
    std::vector<std::string> names;
    for (const std::string& link : links) {
        names.push_back(shown(link));
    }
    return names.empty() ? ""
                         : fmt::format("{} link{} {} geometry only and no spheres: {}.\n", names.size(),
                                       names.size() == 1 ? " has" : "s have", geometry, first_names(names));
}

std::string with_capital(std::string text) {
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

/// Returns what is proved, without its scope in volume.
std::string clause_of(const ProvedLinks& links) {
    const bool outer = links.guarantee == Guarantee::outer;
    if (links.proved == 0) {
        return outer ? fmt::format("not proved: the geometry may extend beyond the {}", links.elements)
                     : fmt::format("not proved: the {} may extend beyond the geometry", links.elements);
    }
    const char* proved = links.all() ? "proved" : "proved in part";
    const std::string count = links_text(links.proved, links.with_geometry);
    const char* whose = links.with_geometry == 1 ? "its" : "their";
    const char* precision = links.float32 ? ", also in single precision" : "";
    return outer ? fmt::format("{}: the {} of {} lies inside {} {}, {}{}", proved, to_string(links.geometry), count,
                               whose, links.elements, as_what(links), precision)
                 : fmt::format("{}: the {} of {} lie inside {} {}{}", proved, links.elements, count, whose,
                               to_string(links.geometry), precision);
}

/// Returns "what: a (skip in the recipe), b, c (...)", a reason once for neighbours that share it; empty for no links.
std::string with_reasons(const std::vector<ProvedLinks::LeftOut>& links, const char* what) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const bool last = i + 1 == links.size() || links[i + 1].reason != links[i].reason;
        names.push_back(shown(links[i].link) + (last ? fmt::format(" ({})", shown(links[i].reason)) : ""));
    }
    return names.empty() ? "" : fmt::format("{}: {}", what, fmt::join(names, ", "));
}

std::string left_out_text(const ProvedLinks& links) {
    return with_reasons(links.left_out,
                        links.guarantee == Guarantee::fitted ? "left out" : "not part of the proof");
}

} // namespace

std::vector<std::string> visual_only_links(const Robot& robot) {
    std::vector<std::string> names;
    for (const Link& link : robot.links) {
        if (link.collisions.empty() && !link.visuals.empty()) {
            names.push_back(link.name);
        }
    }
    return names;
}

std::string why_surface_alone(const Solid& solid) {
    if (solid.covers() == Covers::solid) {
        return "";
    }
    const std::vector<Solid::Part>& parts = solid.parts();
    if (std::any_of(parts.begin(), parts.end(), [](const Solid::Part& p) { return p.covers == Covers::surface; })) {
        return "covers: surface";
    }
    return parts.size() == 1 ? "its mesh is open" : "a mesh of it is open";
}

std::string as_what(const ProvedLinks& links) {
    const std::size_t surfaces = links.as_surface.size(), solids = links.proved - std::min(links.proved, surfaces);
    const auto some = [](std::size_t count, const char* one, const char* many) {
        return count == 1 ? fmt::format("as a {}", one) : fmt::format("as {}", many);
    };
    if (surfaces == 0) {
        return some(solids, "solid", "solids");
    }
    const std::string rest = some(surfaces, "surface", "surfaces");
    return solids == 0 ? rest : fmt::format("{} {}, {} {}", solids, some(solids, "solid", "solids"), surfaces, rest);
}

std::string surfaces_text(const ProvedLinks& links) {
    return with_reasons(links.as_surface, "as a surface");
}

std::string missing_text(const ProvedLinks& links) {
    if (links.guarantee != Guarantee::outer || links.missing == 0) {
        return "";
    }
    if (!std::isfinite(links.missing)) {
        return fmt::format("how much of the volume lies outside all {} was not measured", links.elements);
    }
    const double percent = 100 * links.missing;
    const std::string share = percent < 0.01    ? "less than 0.01 %"
                              : percent >= 99.5 ? "100 %" // two digits of it are 1e+02
                                                : fmt::format("{:.2g} %", percent);
    return fmt::format("{} of the volume lies outside all {}", share, links.elements);
}

std::string verdict_of(const ProvedLinks& links) {
    if (links.guarantee == Guarantee::fitted) {
        return with_capital(nothing_is_proved) + ".\n";
    }
    std::string text = with_capital(clause_of(links)) + ".\n";
    for (const std::string& more : {surfaces_text(links), missing_text(links)}) {
        text += more.empty() ? "" : with_capital(more) + ".\n";
    }
    return text;
}

std::string statement_of(const ProvedLinks& links) {
    std::string text =
        links.guarantee == Guarantee::fitted ? nothing_is_proved : clause_of(links);
    for (const std::string& more : {surfaces_text(links), missing_text(links), left_out_text(links)}) {
        text += more.empty() ? "" : "; " + more;
    }
    return text;
}

std::string omissions_of(const ProvedLinks& links) {
    const std::string left_out = left_out_text(links);
    return (left_out.empty() ? "" : with_capital(left_out) + ".\n") + only_text(links.visual_only, "visual") +
           only_text(links.collision_only, "collision");
}

} // namespace foam::inline robot
