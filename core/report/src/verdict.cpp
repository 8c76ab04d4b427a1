#include "sections.hpp"

#include <foam/robot/proved_links.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline report {

std::string guarantee_of(const Report& report) {
    return report.manifest["settings"]["guarantee"].get<std::string>();
}

bool certified(const Report& report) {
    return report.manifest["certified"].get<bool>();
}

bool has_other_elements(const Report& report) {
    const Json& links = report.manifest["links"];
    return std::any_of(links.begin(), links.end(), [](const Json& link) { return link.contains("kinds"); });
}

/// Returns the proved links of the manifest.
static ProvedLinks proved_links(const Report& report) {
    const Json& proof = report.manifest["proof"];
    ProvedLinks links;
    links.guarantee = guarantee_of(report) == "outer"   ? Guarantee::outer
                      : guarantee_of(report) == "inner" ? Guarantee::inner
                                                        : Guarantee::fitted;
    links.with_geometry = proof["links_with_geometry"].get<std::size_t>();
    links.proved = proof["links_proved"].get<std::size_t>();
    proof["visual_only"].get_to(links.visual_only);
    proof["collision_only"].get_to(links.collision_only);
    const std::vector<std::string>& words = words_of_covered_geometry();
    links.geometry = static_cast<CoveredGeometry>(
        std::find(words.begin(), words.end(), proof["geometry"].get<std::string>()) - words.begin());
    links.missing = proof["missing"].is_null() ? std::numeric_limits<double>::quiet_NaN() : proof["missing"].get<double>();
    links.elements = has_other_elements(report) ? "elements" : "spheres";
    links.float32 = report.manifest["settings"].value("numbers", "") == "float32";
    for (const Json& link : proof["as_surface"]) {
        links.as_surface.push_back({link["link"].get<std::string>(), link["reason"].get<std::string>()});
    }
    for (const Json& link : proof["left_out"]) {
        links.left_out.push_back({link["link"].get<std::string>(), link["reason"].get<std::string>()});
    }
    return links;
}

std::string covered_geometry(const Report& report) {
    return to_string(proved_links(report).geometry);
}

std::string verdict(const Report& report) {
    if (guarantee_of(report) == "fitted") {
        return "No guarantee was asked for: the figures say how well the spheres fit.";
    }
    std::string text = verdict_of(proved_links(report));
    text.erase(text.find_last_not_of('\n') + 1);
    return as_lines(text);
}

std::string omissions(const Report& report) {
    const std::string text = omissions_of(proved_links(report));
    return text.empty() ? "" : fmt::format("<p class=\"note\">{}</p>\n", as_lines(text));
}

std::string verdict_class(const Report& report) {
    if (guarantee_of(report) == "fitted") {
        return "plain";
    }
    return certified(report) ? "yes" : proved_links(report).proved > 0 ? "plain" : "no";
}

} // namespace foam::report
