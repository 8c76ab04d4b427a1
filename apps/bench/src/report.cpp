#include "report.hpp"

#include <foam/runtime/internal/cache.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace foam::inline bench::experiment {
namespace {

/// "model name" of Linux; "unknown" where there is none.
std::string processor() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        if (const std::size_t colon = line.find(": "); line.starts_with("model name") && colon != line.npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

/// Plugins that the experiment's stages come from.
std::string plugin_versions(const Experiment& experiment, const Registry& registry) {
    std::set<std::string> plugins;
    for (const std::string& name : experiment.stages()) {
        if (const RegisteredStage* stage = registry.find(name)) {
            plugins.insert(fmt::format("{} {}", stage->plugin, stage->plugin_version));
        }
    }
    return fmt::format("{}", fmt::join(plugins, ", "));
}

} // namespace

Table circumstances(const Experiment& experiment, const Registry& registry, std::size_t threads) {
    std::vector<std::string> libraries;
    for (const auto& [name, version] : library_versions()) {
        libraries.push_back(name + " " + version);
    }
    const unsigned cores = std::thread::hardware_concurrency();
    return {{"measured on", ""},
            {{"processor", fmt::format("{}, {} thread{}", processor(), cores, cores == 1 ? "" : "s")},
             {"threads of a stage", threads == 0 ? "all" : std::to_string(threads)},
             {"foam", version()},
             {"compiler", fmt::format("{} {}",
#ifdef __clang__
                                      "Clang",
#else
                                      "GCC",
#endif
                                      __VERSION__)},
             {"libraries", fmt::format("{}", fmt::join(libraries, ", "))},
             {"plugins", plugin_versions(experiment, registry)},
             {"experiment",
              fmt::format("{}, digest {}", experiment.file.filename().string(), digest_of(experiment.source))}}};
}

std::string to_markdown(const Experiment& experiment, const Outcome& outcome, const Table& measured_on) {
    std::string text = fmt::format("# {}\n", experiment.title);
    for (const Section& section : outcome.sections) {
        if (!section.title.empty()) {
            text += fmt::format("\n## {}\n", section.title);
        }
        if (!section.text.empty()) {
            text += fmt::format("\n{}\n", section.text.substr(0, section.text.find_last_not_of(' ') + 1));
        }
        if (!section.figure.empty()) {
            text +=
                fmt::format("\n![{}]({})\n", section.title.empty() ? experiment.title : section.title, section.figure);
        }
        if (!section.table.columns.empty()) {
            text += '\n';
            text += to_markdown(section.table);
        }
    }
    text += "\n## Measured on\n\n";
    text += to_markdown(measured_on);
    return text;
}

} // namespace foam::bench::experiment
