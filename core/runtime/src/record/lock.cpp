#include "input/inputs.hpp"
#include "record/record.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/verify.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

/// The differences from the manifest, one line each, by kind.
struct Findings {
    std::vector<std::string> foam, plugins, settings, inputs;

    /// Throws if there are differences.
    void refuse(const std::string& manifest) const;
    std::string remedy() const;
};

std::vector<std::string> other_plugins(const Record& record, const Registry& registry) {
    std::vector<std::string> list;
    for (const PluginVersion& then : record.plugins) {
        const auto& all = registry.plugins();
        const auto now = std::find_if(all.begin(), all.end(),
                                      [&](const PluginRecord& p) { return p.loaded() && p.name == then.name; });
        if (now == all.end()) {
            list.push_back(fmt::format("plugin {}: the manifest has {}, it is not loaded", then.name, then.version));
        } else if (now->version != then.version) {
            list.push_back(
                fmt::format("plugin {}: the manifest has {}, this is {}", then.name, then.version, now->version));
        }
    }
    return list;
}

std::vector<std::string> other_settings(const Record& record, const Recipe& recipe, const Registry& registry) {
    std::vector<std::string> list;
    for (const Difference& d : compare_settings(record.settings, settings_of(recipe, registry))) {
        list.push_back(fmt::format("setting {}: the manifest has {}, the recipe has {}", d.input, d.expected, d.found));
    }
    return list;
}

std::vector<std::string> other_inputs(const Record& record, const Recipe& recipe, const Registry& registry) {
    std::vector<std::string> list;
    std::optional<InputsHere> here;
    try {
        here = inputs_here(recipe, registry);
        for (const Difference& d : compare(record.inputs, here->digests)) {
            const auto file = here->files.find(d.input);
            list.push_back(fmt::format("{} {}: the manifest has {}, here is {}{}", d.stage, d.input, d.expected,
                                       d.found,
                                       file == here->files.end() ? "" : fmt::format(" ({})", file->second.string())));
        }
    } catch (const Error& error) {
        list.push_back(fmt::format("input: {}", error.what()));
    }
    if (!list.empty()) {
        for (std::string& sentence : inputs_elsewhere(record, here)) {
            list.push_back(std::move(sentence));
        }
    }
    return list;
}

std::string Findings::remedy() const {
    std::vector<std::string> steps;
    if (!foam.empty() || !plugins.empty()) {
        steps.emplace_back("install the versions of the manifest");
    }
    if (!settings.empty()) {
        steps.emplace_back("take the recipe of the manifest, without changes by --set");
    }
    if (!inputs.empty()) {
        steps.emplace_back("take the inputs of the manifest (FOAM_PACKAGE_PATH names the folders of packages)");
    }
    steps.emplace_back("or run without --locked for a result of your own");
    return fmt::format("{}", fmt::join(steps, "; "));
}

void Findings::refuse(const std::string& manifest) const {
    std::string lines;
    for (const auto* list : {&foam, &plugins, &settings, &inputs}) {
        for (const std::string& line : *list) {
            lines += "\n  " + line;
        }
    }
    if (!lines.empty()) {
        const bool only_plugins = foam.empty() && settings.empty() && inputs.empty();
        throw Error(only_plugins ? ErrorCode::plugin : ErrorCode::usage,
                    fmt::format("this would not be the run of {}:{}\nremedy: {}", manifest, lines, remedy()));
    }
}

} // namespace

struct Lock::State {
    fs::path manifest;
    Record record;
};

Lock::Lock(const fs::path& manifest) : state_(std::make_unique<State>()) {
    std::error_code error;
    state_->manifest = fs::is_directory(manifest, error) ? manifest / "manifest.json" : manifest;
    state_->record = read_record(state_->manifest);
    require_whole(state_->record);
}

Lock::~Lock() = default;

std::string Lock::name() const {
    return state_->record.settings.at("name").get<std::string>();
}

fs::path Lock::resolved_recipe() const {
    return state_->manifest.parent_path() / "recipe.resolved.yaml";
}

void Lock::check_plugins(const Registry& registry) const {
    Findings findings;
    findings.plugins = other_plugins(state_->record, registry);
    findings.refuse(state_->record.source);
}

void Lock::check_start(const Recipe& recipe, const Registry& registry) const {
    const Record& record = state_->record;
    Findings findings;
    if (record.foam_version != version()) {
        findings.foam.push_back(fmt::format("foam: the manifest has {}, this is {}", record.foam_version, version()));
    }
    findings.plugins = other_plugins(record, registry);
    findings.settings = other_settings(record, recipe, registry);
    findings.inputs = other_inputs(record, recipe, registry);
    findings.refuse(record.source);
}

void Lock::check_outputs(const std::string& manifest) const {
    const Record& expected = state_->record;
    const Record found = parse_record(manifest, "manifest.json of this run");
    const std::vector<Difference> outputs = compare(expected.outputs, found.outputs);
    if (outputs.empty()) {
        return;
    }
    std::string message = fmt::format("the outputs are not those of {}; nothing was written:", expected.source);
    for (const Difference& d : outputs) {
        message += fmt::format("\n  {}: the manifest has {}, this run made {}", d.input, d.expected, d.found);
    }
    const std::vector<Difference> stages = compare(expected.stages, found.stages);
    if (!stages.empty()) {
        message += "\nfirst difference: " + stages.front().place();
    }
    for (const std::string& reason : other_versions(expected, found)) {
        message += "\nlikely reason: " + reason;
    }
    throw Error(ErrorCode::output, message + "\nremedy: install what the manifest names; or run without --locked for a "
                                             "result of your own");
}

} // namespace foam::runtime
