#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double mm_per_m = 1000;

std::string row(const std::string& name, std::size_t width, const Measures& m, const std::string& growth) {
    return fmt::format("{:<{}}  {:>7}  {:>8.3f}  {:>8.3f}  {:>9}  {:>9}\n", name, width, m.spheres, m.excess,
                       m.gap * mm_per_m, m.certified ? "yes" : "no", growth);
}

Json json_of(const Measures& m) {
    return {{"spheres", m.spheres},
            {"area", m.area},
            {"volume", m.volume},
            {"covered", m.covered},
            {"gap", m.gap},
            {"excess", m.excess},
            {"excess_error", m.excess_error},
            {"missing", m.missing},
            {"missing_error", m.missing_error},
            {"protrusion_max", m.protrusion_max},
            {"protrusion_mean", m.protrusion_mean},
            {"certified", m.certified}};
}

const char* to_string(Severity severity) {
    constexpr const char* names[] = {"debug", "info", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

} // namespace

std::string table_of(const RunResult& result, Guarantee guarantee) {
    std::size_t width = 5;
    for (const LinkReport& link : result.links) {
        width = std::max(width, link.link.size());
    }
    std::string table = fmt::format("{:<{}}  {:>7}  {:>8}  {:>8}  {:>9}  {:>9}\n", "link", width, "spheres", "excess",
                                    "gap mm", "certified", "growth mm");
    for (const LinkReport& link : result.links) {
        if (link.skipped) {
            table += fmt::format("{:<{}}  left out by the recipe\n", link.link, width);
        } else if (!link.error.empty() && link.measures.spheres == 0) {
            table += fmt::format("{:<{}}  left out: {}\n", link.link, width, link.error);
        } else {
            table += row(link.link, width, link.measures, fmt::format("{:.3f}", link.growth * mm_per_m));
        }
    }
    table += row("total", width, result.total, "");
    if (guarantee == Guarantee::outer) {
        table += result.certified ? "Proved: the geometry of every link lies inside its spheres.\n"
                                  : "Not proved for every link: geometry may stick out of the spheres.\n";
    }
    return table;
}

Json json_of(const RunResult& result, const Recipe& recipe, const std::filesystem::path& directory) {
    Json json{{"name", recipe.name},
              {"input", result.input},
              {"input_file", result.input_file.string()},
              {"directory", directory.string()},
              {"certified", result.certified},
              {"seconds", result.seconds},
              {"cpu_seconds", result.cpu_seconds},
              {"total", json_of(result.total)},
              {"links", Json::array()},
              {"files", Json::array()},
              {"findings", Json::array()}};
    for (const LinkReport& link : result.links) {
        Json entry{{"link", link.link}, {"skipped", link.skipped}, {"growth", link.growth}};
        entry.update(json_of(link.measures));
        if (!link.error.empty()) {
            entry["error"] = link.error;
        }
        json["links"].push_back(std::move(entry));
    }
    for (const auto& file : result.files) {
        json["files"].push_back(file.string());
    }
    for (const Finding& finding : result.findings) {
        json["findings"].push_back({{"severity", to_string(finding.severity)},
                                    {"link", finding.link},
                                    {"stage", finding.stage},
                                    {"message", finding.message}});
    }
    return json;
}

} // namespace foam::cli
