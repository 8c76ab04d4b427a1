#include <foam/recipe/quick_recipe.hpp>

#include "quick_choices.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>
#include <foam/recipe/mesh_unit.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace foam::inline recipe {
namespace {

std::string ending_of(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension.empty() ? "" : extension.substr(1);
}

std::string endings_of(StageKind kind, const Registry& registry) {
    std::set<std::string> endings;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == kind) {
            endings.insert(stage.info.extensions.begin(), stage.info.extensions.end());
        }
    }
    return fmt::format("{}", fmt::join(endings, ", "));
}

/// Letters that every file system and the recipe's `name` take.
std::string plain_name(const std::filesystem::path& file) {
    const std::filesystem::path stem = file.stem();
    std::string name = (file.extension() == ".xacro" ? stem.stem() : stem).string().substr(0, 80);
    for (char& c : name) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
        c = plain ? c : '_';
    }
    name.erase(0, name.find_first_not_of('-'));
    return name.empty() ? "input" : name;
}

/// Returns the method of a stage, without its kind.
std::string method_of(const std::string& stage) {
    return stage.substr(stage.find('.') + 1);
}

[[noreturn]] void fail_unknown(const std::string& method, bool elements, const Registry& registry) {
    std::vector<std::string> methods;
    for (const auto& [known, candidate] : registry.stages()) {
        if (candidate.kind == StageKind::spherizer && known.starts_with(elements ? "approximate." : "spherize.")) {
            methods.push_back(method_of(known));
        }
    }
    const std::string near = nearest_word(method, methods);
    throw Error(ErrorCode::usage,
                fmt::format("unknown method '{}'{}; there are: {}", method,
                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(methods, ", ")));
}

const RegisteredStage& stage_named(const QuickMethod& method, const Registry& registry) {
    const std::string prefix = method.elements ? "approximate." : "spherize.";
    const bool whole = method.stage.starts_with("spherize.") || method.stage.starts_with("approximate.");
    const RegisteredStage* stage = registry.find(whole ? method.stage : prefix + method.stage);
    if (!stage || stage->kind != StageKind::spherizer) {
        fail_unknown(method.stage, method.elements, registry);
    }
    return *stage;
}

/// Returns the stage that makes elements of these kinds: that of the one kind, else approximate.mixed.
const RegisteredStage& stage_for(const std::vector<Element::Kind>& kinds, const Registry& registry) {
    const RegisteredStage* found = kinds.size() == 1 ? nullptr : registry.find("approximate.mixed");
    for (const auto& [name, stage] : registry.stages()) {
        const bool usual = name == "spherize.cover" || name.starts_with("approximate.");
        if (!found && usual && stage.kind == StageKind::spherizer && stage.info.kinds == kinds) {
            found = &stage;
        }
    }
    if (!found) {
        throw Error(ErrorCode::usage,
                    fmt::format("no plugin makes {}; `foam stages` lists what there is; `foam plugins "
                                "--why` says which plugins were not loaded",
                                words_of(kinds)));
    }
    return *found;
}

/// Returns the parameters of the stage, as YAML.
std::string parameters_of(const QuickMethod& method, const StageInfo& stage) {
    std::vector<std::string> parts;
    const auto has = [&](const std::string& name) {
        return std::any_of(stage.parameters.begin(), stage.parameters.end(),
                           [&](const Parameter& parameter) { return parameter.name == name; });
    };
    if (!method.kinds.empty() && !knows_all(stage.kinds, method.kinds)) {
        throw Error(ErrorCode::usage, fmt::format("{} makes {}, not all of {}; remedy: another --method, or none",
                                                  stage.name, words_of(stage.kinds), words_of(method.kinds)));
    }
    if (has("kinds") && !method.kinds.empty()) {
        std::vector<std::string> words;
        for (const Element::Kind kind : method.kinds) {
            words.emplace_back(to_string(kind));
        }
        parts.push_back(fmt::format("kinds: \"{}\"", fmt::join(words, ", ")));
    } else if (!method.kinds.empty() && method.kinds.size() < stage.kinds.size()) {
        throw Error(ErrorCode::usage,
                    fmt::format("{} makes {}, and has no parameter 'kinds' to choose; remedy: another "
                                "--method, or none",
                                stage.name, words_of(stage.kinds)));
    }
    if (!method.objective.empty()) {
        if (stage.objective_parameter.empty()) {
            throw Error(ErrorCode::usage,
                        fmt::format("{} has one objective only; remedy: without --objective", stage.name));
        }
        parts.push_back(fmt::format("{}: {}", stage.objective_parameter, method.objective));
    }
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

/// Returns the length as YAML: a unit stays, so that only a length without one is questioned.
std::string length_in_recipe(const QuickLength& length) {
    return to_text(length.metres) + (length.has_unit ? "m" : "");
}

std::string budget_text(const QuickBudget& budget, bool elements) {
    std::vector<std::string> parts;
    if (budget.spheres) {
        parts.push_back(fmt::format("{}: {}", elements ? "elements" : "spheres", *budget.spheres));
    }
    if (budget.cost) {
        parts.push_back("cost: " + to_text(*budget.cost));
    }
    if (!budget.costs.empty()) {
        std::vector<std::string> costs;
        for (const auto& [kind, cost] : budget.costs) {
            costs.push_back(fmt::format("{}: {}", kind, to_text(cost)));
        }
        parts.push_back(fmt::format("costs: {{{}}}", fmt::join(costs, ", ")));
    }
    if (budget.excess) {
        parts.push_back("excess: " + to_text(*budget.excess));
    }
    if (budget.max_protrusion) {
        parts.push_back("max_protrusion: " + length_in_recipe(*budget.max_protrusion));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

} // namespace

const RegisteredStage& writer_for(const std::string& format, const Registry& registry) {
    std::vector<const RegisteredStage*> fitting;
    std::vector<std::string> names, all;
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind != StageKind::writer) {
            continue;
        }
        all.push_back(name.substr(name.find('.') + 1));
        if (all.back() == format) {
            return stage;
        }
        const auto& endings = stage.info.extensions;
        if (std::find(endings.begin(), endings.end(), format) != endings.end()) {
            fitting.push_back(&stage);
            names.push_back(all.back());
        }
    }
    if (fitting.size() > 1) {
        throw Error(ErrorCode::usage, fmt::format("several formats write .{}: {}; remedy: --format {}", format,
                                                  fmt::join(names, ", "), names.front()));
    }
    if (fitting.empty()) {
        const std::string near = nearest_word(format, all);
        throw Error(ErrorCode::usage,
                    fmt::format("no format '{}'{}; there are: {}", format,
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(all, ", ")));
    }
    return *fitting.front();
}

void refuse_naming(const std::string& format, const std::filesystem::path& input, const Registry& registry) {
    if (format == "recipe") {
        throw Error(ErrorCode::usage, "a recipe names its input, and - has no name; remedy: a file instead of -");
    }
    const StageInfo& writer = writer_for(format, registry).info;
    const bool names_meshes = std::any_of(writer.parameters.begin(), writer.parameters.end(),
                                          [](const Parameter& parameter) { return parameter.name == "mesh_paths"; });
    if (names_meshes && is_mesh(input, registry)) {
        throw Error(ErrorCode::usage, fmt::format("{} writes the name of the mesh, and - has no name; remedy: another "
                                                  "format, or a file instead of -",
                                                  writer.name));
    }
}

bool is_mesh(const std::filesystem::path& input, const Registry& registry) {
    const std::string ending = ending_of(input);
    if (registry.find_for_extension(StageKind::mesh_loader, ending)) {
        return true;
    }
    if (!registry.find_for_extension(StageKind::robot_loader, ending)) {
        throw Error(ErrorCode::usage, fmt::format("{}: files of type '{}' are not read; robots: {}; meshes: {}",
                                                  input.string(), ending, endings_of(StageKind::robot_loader, registry),
                                                  endings_of(StageKind::mesh_loader, registry)));
    }
    return false;
}

std::string own_format(const std::filesystem::path& input, const Registry& registry) {
    const std::string text = read_file(input, most_robot_bytes);
    for (const RegisteredStage* loader : registry.robot_loaders_of(text)) {
        const std::string format = loader->info.name.substr(loader->info.name.find('.') + 1);
        if (registry.find("write." + format)) {
            return format;
        }
    }
    return "urdf";
}

QuickRecipe quick_recipe(const std::filesystem::path& input, const QuickMethod& method, const std::string& ending,
                         const QuickBudget& budget, const MeshUnit& unit, const std::string& geometry,
                         const Registry& registry, const RobotChoices& choices) {
    const RegisteredStage* writer = &writer_for(ending, registry);
    QuickRecipe recipe;
    recipe.name = plain_name(input) + (method.elements ? "_elements" : "_spheres");
    recipe.output = recipe.name + "." + (writer->info.extensions.empty() ? ending : writer->info.extensions.front());
    recipe.text = fmt::format("foam: 1\nname: {}\n", json_string(recipe.name));
    const std::string file = json_string(std::filesystem::absolute(input).lexically_normal().string());
    if (is_mesh(input, registry)) {
        refuse_choices_of_mesh(choices, input.string());
    }
    recipe.text += is_mesh(input, registry) ? fmt::format("mesh: [{}]\n", file)
                                            : fmt::format("robot:\n  urdf: [{}]\n{}", file, robot_keys(choices));
    if (const std::string why =
            why_refused(unit, input, is_mesh(input, registry) ? InputKind::mesh : InputKind::robot, registry);
        !why.empty()) {
        throw Error(ErrorCode::usage, why);
    }
    recipe.text += unit.unit ? fmt::format("unit: {}\n", *unit.unit) : "";
    recipe.text += unit.scale != 1 ? fmt::format("scale: {}\n", to_text(unit.scale)) : "";
    recipe.text += geometry != "collision" ? fmt::format("cover: {}\n", geometry) : "";
    recipe.text += budget.pad ? fmt::format("pad: {}\n", length_in_recipe(*budget.pad)) : "";
    recipe.text += "stages:\n";
    const StageInfo& spheres =
        (method.elements && method.stage.empty() ? stage_for(method.kinds, registry) : stage_named(method, registry))
            .info;
    const auto add_if_there = [&](const char* stage) {
        if (registry.find(stage)) {
            recipe.text += fmt::format("  - {}: {{}}\n", stage);
        } else {
            recipe.left_out.emplace_back(stage);
        }
    };
    if (!spheres.original_only) {
        for (const char* filter : {"repair.auto", "simplify.quadric", "smooth.humphrey"}) {
            add_if_there(filter);
        }
    }
    recipe.stage = spheres.name;
    recipe.text += fmt::format("  - {}: {}\n", spheres.name, parameters_of(method, spheres));
    if (spheres_alone(spheres.kinds)) {
        for (const char* refiner : {"refine.fit", "refine.clip", "refine.row", "refine.split"}) {
            add_if_there(refiner);
        }
    }
    if (const std::string text = budget_text(budget, method.elements); !text.empty()) {
        recipe.text += fmt::format("budget: {{{}}}   # for the whole robot\n", text);
    }
    recipe.text += links_key(choices);
    recipe.text +=
        fmt::format("guarantee: outer\noutputs:\n  - {}: {{file: {}}}\n", writer->info.name, json_string(recipe.output));
    return recipe;
}

double MeshUnit::factor() const {
    const std::optional<double> metres = metres_in(unit.value_or("m"));
    if (!metres) {
        throw Error(ErrorCode::usage,
                    fmt::format("unknown unit '{}'; there are: {}", *unit, fmt::join(length_units(), ", ")));
    }
    if (!(scale > 0) || !std::isfinite(scale)) {
        throw Error(ErrorCode::usage, fmt::format("a scale is a number above 0, got {}", scale));
    }
    return *metres * scale;
}

std::string why_refused(const MeshUnit& unit, const std::filesystem::path& file, InputKind kind,
                        const Registry& registry, std::string_view preferred) {
    if (!unit.given()) {
        return "";
    }
    if (kind == InputKind::robot) {
        return fmt::format("{} is no mesh: a robot is in metres, and the scale of a mesh of it stands in the URDF, "
                           "<mesh scale=\"0.001 0.001 0.001\"/>; remedy: give no unit and no scale",
                           file.string());
    }
    const std::string ending = extension_of(file);
    const RegisteredStage* loader = registry.find_for_extension(StageKind::mesh_loader, ending, preferred);
    const std::vector<std::string> own = loader ? loader->info.extensions_with_unit : std::vector<std::string>();
    if (unit.unit && std::find(own.begin(), own.end(), ending) != own.end()) {
        return fmt::format(
            "{} says its unit itself, as every {} does; remedy: give no unit, or a scale if that is wrong",
            file.string(), ending);
    }
    return "";
}

} // namespace foam::inline recipe
