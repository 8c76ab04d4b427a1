// Name, verdict and figures of the whole model.
#include "sections.hpp"

#include <fmt/format.h>

namespace foam::inline report {
namespace {

std::string tile(const std::string& term, const std::string& value, const std::string& detail) {
    return fmt::format("<div><dt>{}</dt><dd>{}<small>{}</small></dd></div>\n", term, value, detail);
}

/// Returns "22", or "20 of at most 22".
std::string budget_text(const Json& manifest) {
    const Json& settings = manifest["settings"];
    if (!settings.contains("budget") || !settings["budget"].is_object()) {
        return "no budget: the spherizer’s own parameters ruled";
    }
    const Json& budget = settings["budget"];
    std::string text;
    for (const char* count : {"spheres", "elements"}) {
        if (budget.contains(count) && budget[count].is_number()) {
            text = fmt::format("budget {}", budget[count].get<std::size_t>());
        }
    }
    if (budget.contains("cost") && budget["cost"].is_number()) {
        text += fmt::format("{}cost of at most {}", text.empty() ? "" : ", ", number(budget["cost"].get<double>(), 1));
    }
    if (budget.contains("excess") && budget["excess"].is_number()) {
        text +=
            fmt::format("{}excess of at most {}", text.empty() ? "" : ", ", number(budget["excess"].get<double>(), 3));
    }
    if (budget.contains("max_protrusion") && budget["max_protrusion"].is_number()) {
        text += fmt::format("{}at most {} mm out", text.empty() ? "" : ", ",
                            number(mm_per_m * budget["max_protrusion"].get<double>(), 1));
    }
    return text.empty() ? "no budget: the spherizer’s own parameters ruled" : text;
}

std::string link_count_text(const Report& report) {
    const Json& manifest = report.manifest;
    std::size_t skipped = 0, lost = 0;
    for (const Json& link : manifest["links"]) {
        skipped += link.contains("skipped") ? 1 : 0;
        lost += link.contains("error") ? 1 : 0;
    }
    std::string text = skipped > 0 ? fmt::format("{} excluded by the recipe", skipped) : "";
    if (lost > 0) {
        text += fmt::format("{}{} with an error", text.empty() ? "" : ", ", lost);
    }
    return text.empty() ? "with " + covered_geometry(report) : text;
}

std::string share_text(const Json& measures, const char* figure) {
    return number(value_of(measures[figure]), 3);
}

std::string error_text(const Json& measures, const char* figure) {
    const std::string key = std::string(figure) + "_standard_error";
    return fmt::format("± {} (standard error)", number(value_of(measures[key]), 4));
}

} // namespace

std::string header_section(const Report& report) {
    const Json& manifest = report.manifest;
    return fmt::format("<header>\n<h1>{}</h1>\n<p>{} · {} · made by foam {}</p>\n"
                       "<p class=\"verdict {}\">{}</p>\n{}</header>\n",
                       escaped(manifest["settings"]["name"]), as_text(report.name), escaped(manifest["input"]["file"]),
                       escaped(manifest["foam_version"]), verdict_class(report), verdict(report), omissions(report));
}

std::string summary_section(const Report& report) {
    const Json& manifest = report.manifest;
    const Json &total = manifest["total"], &execution = manifest["execution"];
    std::string html = "<dl class=\"tiles\">\n";
    html += tile("Spheres", fmt::format("{}", total["spheres"].get<std::size_t>()), budget_text(manifest));
    html += tile("Links", fmt::format("{}", report.links.size()), link_count_text(report));
    html += tile("Excess", share_text(total, "excess"), error_text(total, "excess"));
    html += tile("Missing", share_text(total, "missing"), error_text(total, "missing"));
    html += tile("Gap", number(mm_per_m * value_of(total["gap_m"]), 3) + " mm",
                 fmt::format("{} % of the surface covered", number(100 * value_of(total["covered"]), 2)));
    html += tile("Protrusion", number(mm_per_m * value_of(total["protrusion_max_m"]), 1) + " mm",
                 fmt::format("mean {} mm", number(mm_per_m * value_of(total["protrusion_mean_m"]), 1)));
    html += execution_only(tile("Time", number(execution["wall_seconds"].get<double>(), 2) + " s",
                                fmt::format("CPU {} s", number(execution["cpu_seconds"].get<double>(), 2))));
    return section(
        "summary", "Summary",
        html + "</dl>\n" +
            fmt::format(
                "<p class=\"note\">Excess: volume of the spheres outside the geometry / volume of the geometry. "
                "Missing: volume of the geometry outside the spheres / volume of the geometry. Gap: how far the "
                "geometry extends beyond the spheres. Protrusion: how far the spheres extend beyond the geometry. The "
                "geometry is the {} as the input gives it; overlaps count once.</p>\n",
                covered_geometry(report)));
}

} // namespace foam::report
