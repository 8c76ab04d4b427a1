#include <foam/sdk/internal/declaration.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

namespace foam::inline sdk {
namespace {

/// Returns why a parameter cannot have the name: recipes use some keys beside a stage's parameters. Empty if it can.
std::string why_reserved(const RegisteredStage& stage, std::string_view name) {
    if (stage.kind == StageKind::writer && name == "file") {
        return fmt::format("stage '{}': a writer cannot have a parameter 'file', recipes say by that key where it "
                           "writes; remedy: rename it",
                           stage.info.name);
    }
    if (can_be_isolated(stage.kind) && (name == "isolate" || name == "time_limit" || name == "memory_limit")) {
        return fmt::format("stage '{}': a {} cannot have a parameter '{}', recipes say by that key how it is isolated; "
                           "remedy: rename it",
                           stage.info.name, to_string(stage.kind), name);
    }
    return "";
}

/// Returns why a stage's name does not fit its kind, which people read from the name. Empty if it does.
std::string why_misnamed(const RegisteredStage& stage) {
    static constexpr std::pair<StageKind, std::string_view> beginnings[] = {{StageKind::mesh_loader, "load."},
                                                                            {StageKind::robot_loader, "load."},
                                                                            {StageKind::spherizer, "spherize."},
                                                                            {StageKind::spherizer, "approximate."},
                                                                            {StageKind::renderer, "snapshot."},
                                                                            {StageKind::writer, "write."},
                                                                            {StageKind::model_reader, "read."},
                                                                            {StageKind::refiner, "refine."}};
    const std::string& name = stage.info.name;
    std::string_view fits, taken;
    for (const auto& [kind, beginning] : beginnings) {
        const bool begins = name.starts_with(beginning);
        fits = kind == stage.kind && (fits.empty() || begins) ? beginning : fits;
        taken = begins ? beginning : taken;
    }
    if (fits == taken) {
        return "";
    }
    return fits.empty()
               ? fmt::format("stage '{}' is enrolled as a {}, whose name cannot begin with '{}'; remedy: rename "
                             "it, or enrol it as what it is",
                             name, to_string(stage.kind), taken)
               : fmt::format("stage '{}' is enrolled as a {}, whose name begins with '{}'; remedy: rename it, "
                             "or enrol it as what it is",
                             name, to_string(stage.kind), fits);
}

/// Returns why a stage's objective_parameter is not one of its choices; empty if it is, or there is none.
std::string why_no_objective(const StageInfo& info) {
    const std::string& name = info.objective_parameter;
    const bool found = std::any_of(info.parameters.begin(), info.parameters.end(), [&](const Parameter& p) {
        return p.name == name && p.type == Parameter::Type::choice;
    });
    return name.empty() || found
               ? ""
               : fmt::format("stage '{}': objective_parameter '{}' is no choice among its parameters; "
                             "remedy: declare it by Parameter::choice(…)",
                             info.name, name);
}

/// Returns why a stage's kinds of elements cannot be; empty if they can.
std::string why_bad_kinds(const RegisteredStage& stage) {
    const std::vector<Element::Kind>& kinds = stage.info.kinds;
    if (kinds.empty() || std::set<Element::Kind>(kinds.begin(), kinds.end()).size() != kinds.size()) {
        return fmt::format("stage '{}': its kinds of elements are none, or one twice; remedy: .kinds = "
                           "{{Element::Kind::box}}",
                           stage.info.name);
    }
    const bool has_elements = stage.kind == StageKind::spherizer || stage.kind == StageKind::writer ||
                              stage.kind == StageKind::refiner || stage.kind == StageKind::model_reader;
    if (!has_elements && kinds != StageInfo{}.kinds) {
        return fmt::format("stage '{}': a {} makes no elements; remedy: leave StageInfo::kinds out", stage.info.name,
                           to_string(stage.kind));
    }
    if (stage.info.name.starts_with("spherize.") && kinds != StageInfo{}.kinds) {
        return fmt::format("stage '{}' makes other elements than spheres; remedy: name it approximate.{}",
                           stage.info.name, stage.info.name.substr(stage.info.name.find('.') + 1));
    }
    return "";
}

/// Returns why a stage cannot be isolated as it requests; empty if it can, or requests nothing.
std::string why_bad_isolation(const RegisteredStage& stage) {
    const Isolation& wish = stage.info.isolation;
    if (wish == Isolation{}) {
        return "";
    }
    if (!can_be_isolated(stage.kind)) {
        return fmt::format("stage '{}': a {} cannot run in a process of its own; remedy: leave its isolation empty",
                           stage.info.name, to_string(stage.kind));
    }
    const bool good_time = !wish.time_limit || (std::isfinite(*wish.time_limit) && *wish.time_limit > 0);
    if (!wish.process.value_or(false) || !good_time || wish.memory_limit == std::size_t{0}) {
        return fmt::format("stage '{}': its isolation is no process with limits above 0; remedy: .isolation = "
                           "{{.process = true, .time_limit = 60, .memory_limit = 4096}}",
                           stage.info.name);
    }
    return "";
}

/// Returns the error in a stage's declaration; empty if there is none.
std::string why_badly_declared(const RegisteredStage& stage) {
    const StageInfo& info = stage.info;
    static const std::regex stage_name("[a-z][a-z0-9]*\\.[a-z][a-z0-9_]*");
    if (!std::regex_match(info.name, stage_name)) {
        return fmt::format(
            "stage name '{}' is not of the form kind.method in lower case, e.g. spherize.mine; remedy: rename it",
            info.name);
    }
    if (const std::string why = why_misnamed(stage); !why.empty()) {
        return why;
    }
    if (info.summary.empty()) {
        return fmt::format("stage '{}' has no summary; remedy: say in one sentence what it does", info.name);
    }
    if (!stage.factory) {
        return fmt::format("stage '{}' has no factory; remedy: enrol it with enrol.add<…>()", info.name);
    }
    static const std::regex parameter_name("[A-Za-z][A-Za-z0-9_]*");
    std::set<std::string> names;
    for (const Parameter& p : info.parameters) {
        if (const std::string why = why_reserved(stage, p.name); !why.empty()) {
            return why;
        }
        if (p.name.empty() || !names.insert(p.name).second) {
            return fmt::format("stage '{}' declares parameter '{}' twice or without a name; remedy: rename it",
                               info.name, p.name);
        }
        if (!std::regex_match(p.name, parameter_name)) {
            return fmt::format("stage '{}': the name of parameter '{}' is not a word of letters, digits "
                               "and _; remedy: rename it",
                               info.name, p.name);
        }
        if (p.doc_text.empty()) {
            return fmt::format("stage '{}': parameter '{}' has no doc sentence; remedy: call .doc(…)", info.name,
                               p.name);
        }
        if (const std::string why = why_invalid(p, p.default_value); !why.empty()) {
            return fmt::format("stage '{}': the default of parameter '{}' breaks its own declaration: {}; remedy: "
                               "correct the one or the other",
                               info.name, p.name, why);
        }
    }
    if (const std::string why = why_bad_kinds(stage); !why.empty()) {
        return why;
    }
    const std::string why = why_bad_isolation(stage);
    return why.empty() ? why_no_objective(info) : why;
}

} // namespace

bool can_be_isolated(StageKind kind) {
    return kind == StageKind::mesh_loader || kind == StageKind::mesh_filter || kind == StageKind::spherizer;
}

std::string why_bad(const std::vector<RegisteredStage>& stages, const Registry& registry) {
    if (stages.empty()) {
        return "it enrols no stage; remedy: call enrol.add<…>() in the body of FOAM_PLUGIN";
    }
    std::set<std::string> names;
    for (const RegisteredStage& stage : stages) {
        if (const std::string why = why_badly_declared(stage); !why.empty()) {
            return why;
        }
        if (const RegisteredStage* other = registry.find(stage.info.name)) {
            return fmt::format(
                "stage '{}' exists already, from plugin {}; remedy: give it another name, or load only one of "
                "the two",
                stage.info.name, other->plugin);
        }
        if (!names.insert(stage.info.name).second) {
            return fmt::format("it enrols stage '{}' twice; remedy: give one another name", stage.info.name);
        }
    }
    return "";
}

} // namespace foam::sdk
