#include <foam/robot/proved_links.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline robot {
namespace {

constexpr std::size_t most_named = 3;

/// Returns the first names, and how many more there are.
std::string named(const std::vector<std::string>& names) {
    const std::size_t shown = std::min(names.size(), most_named);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    return shown < names.size() ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

std::string links_text(std::size_t proved, std::size_t all) {
    return fmt::format("{} of {} link{}", proved, all, all == 1 ? "" : "s");
}

/// Returns a sentence about links that have no geometry to be covered, but another; empty if there are none.
std::string only_text(const std::vector<std::string>& links, const char* geometry) {
    std::vector<std::string> names;
    for (const std::string& link : links) {
        names.push_back(shown(link));
    }
    return names.empty() ? ""
                         : fmt::format("{} link{} {} geometry only and no spheres: {}.\n", names.size(),
                                       names.size() == 1 ? " has" : "s have", geometry, named(names));
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

std::string verdict_of(const ProvedLinks& links, std::string_view elements) {
    const bool outer = links.guarantee == Guarantee::outer;
    if (links.guarantee == Guarantee::fitted) {
        return "";
    }
    if (links.proved == 0) {
        return outer ? fmt::format("Not proved: the geometry may extend beyond the {}.\n", elements)
                     : fmt::format("Not proved: the {} may extend beyond the geometry.\n", elements);
    }
    const std::string count = links_text(links.proved, links.with_geometry);
    const char* whose = links.with_geometry == 1 ? "its" : "their";
    const char* geometry = to_string(links.geometry);
    return outer ? fmt::format("Proved: the {} of {} lies inside {} {}.\n", geometry, count, whose, elements)
                 : fmt::format("Proved: the {} of {} lie inside {} {}.\n", elements, count, whose, geometry);
}

std::string omissions_of(const ProvedLinks& links) {
    std::string text;
    if (!links.left_out.empty()) {
        std::vector<std::string> names;
        for (const ProvedLinks::LeftOut& link : links.left_out) {
            names.push_back(fmt::format("{} ({})", shown(link.link), shown(link.reason)));
        }
        text += fmt::format("{}: {}.\n", links.guarantee == Guarantee::fitted ? "Left out" : "Not part of the proof",
                            named(names));
    }
    return text + only_text(links.visual_only, "visual") + only_text(links.collision_only, "collision");
}

} // namespace foam::inline robot
