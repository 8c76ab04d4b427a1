#include "kinds.hpp"

#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <array>

namespace foam::inline bench {

Experiment::Experiment() = default;
Experiment::~Experiment() = default;

namespace experiment {

using namespace reading;

namespace {

constexpr int format_version = 1;
constexpr const char* version_key = "foam_experiment";

std::vector<Parameter> shared_values() {
    std::vector<std::string> names;
    for (const Kind& kind : kinds()) {
        names.emplace_back(kind.name);
    }
    return {Parameter::text("name", ""), Parameter::text("title", ""), Parameter::choice("kind", names, names.front())};
}

bool has_version(const Value& root, Findings& findings) {
    const Value* version = root.find(version_key);
    if (!version) {
        findings.error({0, 1, 1}, "missing-key",
                       root.find("foam") ? "this is a recipe; remedy: run it by `foam run`"
                                         : fmt::format("the version of the experiment format is missing; remedy: "
                                                       "begin with '{}: {}'",
                                                       version_key, format_version));
    } else if (!version->is(Value::Kind::integer) || version->whole != format_version) {
        findings.error(version->where, "version",
                       fmt::format("this foam reads experiment format {0}, the file says {1}; remedy: write '{2}: {0}'",
                                   format_version, version->description(), version_key));
    }
    return version != nullptr;
}

/// The kind's name; empty after a finding.
std::string read_kind(const Value& root, Findings& findings) {
    const Parameter declared = shared_values().back();
    if (const Value* value = required(root, "kind", "kind: time_against_triangles", findings)) {
        if (const auto kind = read_value(*value, declared, "", findings)) {
            return std::get<std::string>(*kind);
        }
    }
    return "";
}

std::string read_text_value(const Value* value, const char* name, Findings& findings) {
    const auto text = value ? read_value(*value, Parameter::text(name, ""), "", findings) : std::nullopt;
    return text ? std::get<std::string>(*text) : "";
}

void read_names(const Value& root, Experiment& experiment, Findings& findings) {
    const Value* name = required(root, "name", "name: my_experiment", findings);
    experiment.name = read_text_value(name, "name", findings);
    if (name && name->is(Value::Kind::text)) {
        if (const std::string why = why_no_folder_name(experiment.name); !why.empty()) {
            findings.error(
                name->where, "bad-name",
                fmt::format("'name' is the name of the folder of results; {} {}", in_quotes(experiment.name), why));
        }
    }
    experiment.title = read_text_value(root.find("title"), "title", findings);
    if (experiment.title.empty()) {
        experiment.title = experiment.name;
    }
}

std::unique_ptr<Experiment> read_root(const std::string& text, const Checking& checking) {
    Findings& findings = checking.findings;
    const std::optional<Value> root = check_text(text, 0, findings) ? read_yaml(text, 0, findings) : std::nullopt;
    if (!root) {
        return nullptr;
    }
    if (!root->is(Value::Kind::map)) {
        findings.error({0, 1, 1}, "wrong-type",
                       fmt::format("an experiment is a map, got {}; remedy: begin with '{}: {}'", root->description(),
                                   version_key, format_version));
        return nullptr;
    }
    if (!has_version(*root, findings)) {
        return nullptr;
    }
    const std::string name = read_kind(*root, findings);
    for (const Kind& kind : kinds()) {
        if (name == kind.name) {
            auto experiment = kind.read(*root, checking);
            experiment->kind = name;
            read_names(*root, *experiment, findings);
            return experiment;
        }
    }
    return nullptr;
}

ExperimentReading finish(std::unique_ptr<Experiment> experiment, const std::string& text,
                         const std::filesystem::path& file, Findings& findings) {
    ExperimentReading reading;
    if (experiment && !findings.any_error()) {
        experiment->file = file;
        experiment->source = text;
        reading.experiment = std::move(experiment);
    }
    reading.diagnostics = findings.take();
    return reading;
}

} // namespace

std::span<const Kind> kinds() {
    static constexpr std::array<Kind, 7> all{{{"time_against_triangles", read_time_against_triangles},
                                              {"program_against_size", read_program_against_size},
                                              {"quality_against_spheres", read_quality_against_spheres},
                                              {"collision_queries", read_collision_queries},
                                              {"element_checks", read_element_checks},
                                              {"fidelity", read_fidelity},
                                              {"throughput", read_throughput}}};
    return all;
}

std::map<std::string, ParameterValue> read_kind_values(const Value& root, const std::vector<Parameter>& declared,
                                                       std::initializer_list<const char*> structures,
                                                       const Checking& checking) {
    std::vector<std::string> others(structures.begin(), structures.end());
    others.emplace_back(version_key);
    for (const Parameter& p : shared_values()) {
        others.push_back(p.name);
    }
    return read_values(root, declared, "", others, checking.findings);
}

std::optional<Chain> read_method(const Value& value, const Checking& checking) {
    auto method = read_chain(value, "method", {false, true, true, "mesh filters and a spherizer"}, checking);
    if (method && !method->spherizer) {
        checking.findings.error(value.where, "missing-stage",
                                "'method' has no spherizer; remedy: add one as its last stage");
    }
    return method;
}

std::vector<Chain> read_methods(const Value& root, const char* example, const Checking& checking) {
    const Value* value = required(root, "methods", example, checking.findings);
    if (!value) {
        return {};
    }
    std::vector<Chain> methods =
        read_chains(*value, "methods", {false, true, true, "mesh filters and spherizers"}, checking);
    for (const Chain& method : methods) {
        if (!method.spherizer) {
            checking.findings.error(value->where, "missing-stage",
                                    fmt::format("the method {} has no spherizer; remedy: add one as its last stage",
                                                in_quotes(method.label)));
        }
    }
    return methods;
}

const Value* required(const Value& root, const char* key, const char* example, Findings& findings) {
    const Value* value = root.find(key);
    if (!value) {
        findings.error({0, 1, 1}, "missing-key", fmt::format("'{}' is missing; remedy: write {}", key, example));
    }
    return value;
}

std::vector<std::size_t> read_counts(const Value& value, const char* key, double low, double high, Findings& findings) {
    std::vector<std::size_t> counts;
    if (!expect_list(value, key, fmt::format("{}: [1, 2, 4]", key), findings)) {
        return counts;
    }
    if (value.items.empty()) {
        findings.error(value.where, "wrong-type", fmt::format("'{}' expects at least one number", key));
    }
    const Parameter declared = Parameter::integer(key, static_cast<std::int64_t>(low)).bounds(low, high);
    for (const Value& item : value.items) {
        const auto read = read_value(item, declared, "", findings);
        if (!read) {
            continue;
        }
        const auto count = static_cast<std::size_t>(std::get<std::int64_t>(*read));
        if (!counts.empty() && count <= counts.back()) {
            findings.error(item.where, "out-of-order",
                           fmt::format("'{}' expects ascending numbers, got {} after {}", key, count, counts.back()));
        }
        counts.push_back(count);
    }
    return counts;
}

std::vector<std::size_t> required_counts(const Value& root, const char* key, const char* example, double low,
                                         double high, Findings& findings) {
    const Value* value = required(root, key, example, findings);
    return value ? read_counts(*value, key, low, high, findings) : std::vector<std::size_t>{};
}

std::vector<NamedRobot> read_robots(const Value& root, Findings& findings) {
    constexpr const char* example = "robots: {panda: FILE.urdf}";
    std::vector<NamedRobot> robots;
    const Value* value = required(root, "robots", example, findings);
    if (!value || !expect_map(*value, "robots", example, findings)) {
        return robots;
    }
    for (std::size_t i = 0; i < value->keys.size(); ++i) {
        const std::string& name = value->keys[i].text;
        robots.push_back(
            {name, read_references(value->items[i], name, findings), findings.locate(value->items[i].where)});
    }
    if (robots.empty()) {
        findings.error(value->where, "wrong-type", "'robots' expects at least one robot");
    }
    return robots;
}

} // namespace experiment

ExperimentReading parse_experiment(const std::string& text, const std::filesystem::path& file,
                                   const Registry& registry) {
    reading::Findings findings(file.empty() ? "experiment" : file.string());
    return experiment::finish(experiment::read_root(text, {registry, findings}), text, file, findings);
}

ExperimentReading read_experiment(const std::filesystem::path& file, const Registry& registry) {
    reading::Findings findings(file.string());
    std::string text;
    if (const std::string why = reading::read_text(file, text); !why.empty()) {
        findings.error({}, "cannot-read", why);
        return experiment::finish(nullptr, text, file, findings);
    }
    return parse_experiment(text, file, registry);
}

} // namespace foam::bench
