// Recipe -> YAML.
#include "format.hpp"

#include <foam/recipe/internal/keys.hpp>
#include <foam/recipe/internal/yaml.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/resource.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline recipe {
namespace {

namespace fs = std::filesystem;
using reading::Value;

std::string yaml_value(const ParameterValue& value) {
    const std::string* text = std::get_if<std::string>(&value);
    return text ? yaml::scalar_text(*text) : to_text(value);
}

std::string yaml_list(const std::vector<std::string>& texts) {
    std::vector<std::string> items;
    std::transform(texts.begin(), texts.end(), std::back_inserter(items),
                   [](const std::string& text) { return yaml::scalar_text(text); });
    return fmt::format("[{}]", fmt::join(items, ", "));
}

class Emitter {
public:
    Emitter(const Recipe& recipe, const Registry& registry, bool absolute_paths)
        : recipe_(recipe), registry_(registry), absolute_paths_(absolute_paths) {}

    std::string text() {
        line("foam: {}", reading::format_version);
        line("name: {}", yaml::scalar_text(recipe_.name));
        line("seed: {}", recipe_.seed);
        write_input();
        write_loaders();
        line("stages:");
        for (const StageCall* call : recipe_.stages()) {
            line("  - {}", stage(*call, {}, true));
        }
        for (const std::string& part : isolation_parts(recipe_.isolation)) {
            line("{}", part);
        }
        write_key("per");
        write_budget();
        write_key("guarantee");
        write_key("cover");
        write_key("pad");
        write_key("hollow");
        write_key("covers");
        write_key("numbers");
        write_self_collision();
        write_links();
        write_outputs();
        write_snapshots();
        line("debug: {{{}}}", fmt::join(parts_of(reading::debug_keys(), recipe_), ", "));
        write_key("on_error");
        write_key("strict");
        return std::move(text_);
    }

private:
    template <class... Args> void line(fmt::format_string<Args...> format, Args&&... args) {
        text_ += fmt::format(format, std::forward<Args>(args)...) + "\n";
    }

    /// Returns "stage: {file: …, parameter: value}", with the defaults or only with the given parameters.
    std::string stage(const StageCall& call, const OutputCall& output, bool defaults) const {
        std::vector<std::string> parts;
        if (!output.file.empty()) {
            parts.push_back("file: " + yaml::scalar_text(output.file));
        }
        if (!output.into.empty()) {
            parts.push_back("into: " + yaml::scalar_text(references({output.into}).front()));
        }
        std::map<std::string, ParameterValue> values = call.given;
        if (const RegisteredStage* known = registry_.find(call.stage); known && defaults) {
            for (const Parameter& p : known->info.parameters) {
                values.emplace(p.name, p.default_value);
            }
        }
        for (const auto& [name, value] : values) {
            parts.push_back(fmt::format("{}: {}", yaml::scalar_text(name), yaml_value(value)));
        }
        const std::vector<std::string> isolation = isolation_parts(call.isolation);
        parts.insert(parts.end(), isolation.begin(), isolation.end());
        return fmt::format("{}: {{{}}}", yaml::scalar_text(call.stage), fmt::join(parts, ", "));
    }

    void write_loaders() {
        std::vector<std::string> loaders;
        if (!recipe_.preferred_loader.empty()) {
            loaders.push_back("prefer: " + yaml::scalar_text(recipe_.preferred_loader));
        }
        for (const StageCall& loader : recipe_.loaders) {
            loaders.push_back(stage(loader, {}, true));
        }
        if (!loaders.empty()) {
            line("loaders: {{{}}}", fmt::join(loaders, ", "));
        }
    }

    static std::vector<std::string> isolation_parts(const Isolation& isolation) {
        std::vector<std::string> parts;
        if (isolation.process) {
            parts.push_back(fmt::format("isolate: {}", *isolation.process ? "process" : "none"));
        }
        if (isolation.time_limit) {
            parts.push_back("time_limit: " + to_text(*isolation.time_limit));
        }
        if (isolation.memory_limit) {
            parts.push_back(fmt::format("memory_limit: {}", *isolation.memory_limit));
        }
        return parts;
    }

    std::vector<std::string> references(std::vector<std::string> references) const {
        if (absolute_paths_) {
            for (std::string& reference : references) {
                const bool uri = reference.find("://") != std::string::npos;
                if (!uri && !fs::path(reference).is_absolute()) {
                    reference = fs::absolute(recipe_.file.parent_path() / reference).string();
                }
            }
        }
        return references;
    }

    void write_input() {
        if (!recipe_.mesh.empty()) {
            line("mesh: {}", yaml_list(references(recipe_.mesh)));
            write_key("unit");
            write_key("scale");
        } else {
            std::vector<std::string> parts{"urdf: " + yaml_list(references(recipe_.urdf))};
            const yaml::Value facts = reading::given_facts(recipe_.facts);
            for (std::size_t i = 0; i < facts.keys.size(); ++i) {
                parts.push_back(facts.keys[i].text + ": " + yaml::flow_text(facts.items[i]));
            }
            line("robot: {{{}}}", fmt::join(parts, ", "));
        }
        if (!recipe_.package_path.empty()) {
            std::vector<std::string> entries = recipe_.package_path;
            for (std::string& entry : entries) {
                entry =
                    absolute_paths_ ? package_entry(entry, fs::current_path() / recipe_.file.parent_path()).string() : entry;
            }
            line("package_path: {}", yaml_list(entries));
        }
        if (!recipe_.plugins.empty()) {
            line("plugins: {}", yaml_list(references(recipe_.plugins)));
        }
    }

    /// Returns "key: value" for each key that is present.
    template <class Keys, class T> static std::vector<std::string> parts_of(const Keys& keys, const T& holder) {
        std::vector<std::string> parts;
        for (const auto& [key, value] : reading::present(keys, holder)) {
            parts.push_back(fmt::format("{}: {}", key->declared.name, yaml_value(value)));
        }
        return parts;
    }

    void write_key(std::string_view name) {
        if (const auto value = reading::value_of(name, reading::top_level_keys(), recipe_)) {
            line("{}: {}", name, yaml_value(*value));
        }
    }

    void write_budget() {
        std::vector<std::string> parts = parts_of(reading::budget_keys(), recipe_);
        if (const auto costs = parts_of(reading::cost_keys(), recipe_); !costs.empty()) {
            parts.push_back(fmt::format("costs: {{{}}}", fmt::join(costs, ", ")));
        }
        if (!parts.empty()) {
            line("budget: {{{}}}", fmt::join(parts, ", "));
        }
    }

    static std::string pose_text(const JointValues& values) {
        std::vector<std::string> joints;
        for (const auto& [joint, value] : values) {
            joints.push_back(fmt::format("{}: {}", yaml::scalar_text(joint), to_text(value)));
        }
        return fmt::format("{{{}}}", fmt::join(joints, ", "));
    }

    void write_self_collision() {
        if (recipe_.self_collision) {
            line("self_collision: {{pose: {}}}", pose_text(recipe_.self_collision_pose));
        }
    }

    static std::string clip_text(const std::vector<ClipPlane>& planes) {
        std::vector<std::string> parts;
        for (const ClipPlane& p : planes) {
            parts.push_back(fmt::format("{{normal: [{}, {}, {}], offset: {}, reach: {}}}", to_text(p.normal.x),
                                        to_text(p.normal.y), to_text(p.normal.z), to_text(p.offset), to_text(p.reach)));
        }
        return fmt::format("[{}]", fmt::join(parts, ", "));
    }

    static std::string keep_text(const std::vector<Sphere>& spheres) {
        std::vector<std::string> parts;
        for (const Sphere& s : spheres) {
            parts.push_back(fmt::format("[{}, {}, {}, {}]", to_text(s.center.x), to_text(s.center.y),
                                        to_text(s.center.z), to_text(s.radius)));
        }
        return fmt::format("[{}]", fmt::join(parts, ", "));
    }

    void write_links() {
        if (!recipe_.links.empty()) {
            line("links:");
        }
        for (const LinkOverride& link : recipe_.links) {
            std::vector<std::string> parts = parts_of(reading::link_keys(), link);
            if (link.clip) {
                parts.push_back("clip: " + clip_text(*link.clip));
            }
            if (link.keep) {
                parts.push_back("keep: " + keep_text(*link.keep));
            }
            for (const StageCall& call : link.stages) {
                parts.push_back(stage(call, {}, false));
            }
            line("  {}: {{{}}}", yaml::scalar_text(link.glob), fmt::join(parts, ", "));
        }
    }

    void write_outputs() {
        line("outputs:{}", recipe_.outputs.empty() ? " []" : "");
        for (const OutputCall& output : recipe_.outputs) {
            line("  - {}", stage(output.writer, output, true));
        }
    }

    void write_snapshots() {
        if (!recipe_.snapshots) {
            line("snapshots: false");
            return;
        }
        StageCall renderer = recipe_.renderer;
        renderer.stage = renderer.stage.empty() ? reading::default_renderer : renderer.stage;
        line("snapshots:");
        line("  size: [{}, {}]", recipe_.snapshot_size[0], recipe_.snapshot_size[1]);
        line("  pose: {}", pose_text(recipe_.pose));
        line("  renderer: {{{}}}", stage(renderer, {}, true));
    }

    const Recipe& recipe_;
    const Registry& registry_;
    bool absolute_paths_;
    std::string text_;
};

} // namespace

std::string to_yaml(const Recipe& recipe, const Registry& registry, bool absolute_paths) {
    return Emitter(recipe, registry, absolute_paths).text();
}

} // namespace foam::inline recipe
