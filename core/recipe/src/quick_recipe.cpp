#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/quick_recipe.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
    std::string name = file.stem().string().substr(0, 80);
    for (char& c : name) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
        c = plain ? c : '_';
    }
    name.erase(0, name.find_first_not_of('-'));
    return (name.empty() ? "input" : name) + "_spheres";
}

const RegisteredStage& spherizer(const std::string& method, const Registry& registry) {
    const RegisteredStage* stage = registry.find(method.starts_with("spherize.") ? method : "spherize." + method);
    if (stage && stage->kind == StageKind::spherizer) {
        return *stage;
    }
    std::vector<std::string> methods;
    for (const auto& [known, candidate] : registry.stages()) {
        if (candidate.kind == StageKind::spherizer) {
            methods.push_back(known.substr(known.find('.') + 1));
        }
    }
    const std::string near = nearest_word(method, methods);
    throw Error(ErrorCode::usage,
                fmt::format("unknown method '{}'{}; there are: {}", method,
                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(methods, ", ")));
}

std::string budget_text(const QuickBudget& budget) {
    std::vector<std::string> parts;
    if (budget.spheres) {
        parts.push_back(fmt::format("spheres: {}", *budget.spheres));
    }
    if (budget.excess) {
        parts.push_back("excess: " + to_text(*budget.excess));
    }
    if (budget.max_protrusion) {
        parts.push_back("max_protrusion: " + to_text(*budget.max_protrusion));
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

bool is_mesh(const std::filesystem::path& input, const Registry& registry) {
    const std::string ending = ending_of(input);
    if (registry.find_for_extension(StageKind::mesh_loader, ending)) {
        return true;
    }
    if (ending == "xacro") {
        throw Error(ErrorCode::usage, fmt::format("{}: xacro is not read; remedy: xacro {} > robot.urdf",
                                                  input.string(), input.string()));
    }
    if (!registry.find_for_extension(StageKind::robot_loader, ending)) {
        throw Error(ErrorCode::usage, fmt::format("{}: files of type '{}' are not read; robots: {}; meshes: {}",
                                                  input.string(), ending, endings_of(StageKind::robot_loader, registry),
                                                  endings_of(StageKind::mesh_loader, registry)));
    }
    return false;
}

QuickRecipe quick_recipe(const std::filesystem::path& input, const std::string& method, const std::string& ending,
                         const QuickBudget& budget, const MeshUnit& unit, const std::string& geometry,
                         const Registry& registry) {
    const RegisteredStage* writer = &writer_for(ending, registry);
    QuickRecipe recipe;
    recipe.name = plain_name(input);
    recipe.output = recipe.name + "." + (writer->info.extensions.empty() ? ending : writer->info.extensions.front());
    const auto quoted = [](const std::string& text) { // a JSON string is a YAML string
        return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    };
    recipe.text = fmt::format("foam: 1\nname: {}\n", quoted(recipe.name));
    const std::string file = quoted(std::filesystem::absolute(input).lexically_normal().string());
    recipe.text +=
        is_mesh(input, registry) ? fmt::format("mesh: [{}]\n", file) : fmt::format("robot:\n  urdf: [{}]\n", file);
    if (const std::string why =
            why_refused(unit, input, is_mesh(input, registry) ? InputKind::mesh : InputKind::robot, registry);
        !why.empty()) {
        throw Error(ErrorCode::usage, why);
    }
    recipe.text += unit.unit ? fmt::format("unit: {}\n", *unit.unit) : "";
    recipe.text += unit.scale != 1 ? fmt::format("scale: {}\n", to_text(unit.scale)) : "";
    recipe.text += geometry != "collision" ? fmt::format("cover: {}\n", geometry) : "";
    recipe.text += "stages:\n";
    const StageInfo& spheres = spherizer(method, registry).info;
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
    recipe.text += fmt::format("  - {}: {{}}\n", spheres.name);
    for (const char* refiner : {"refine.fit", "refine.clip", "refine.row", "refine.split"}) {
        add_if_there(refiner);
    }
    if (const std::string text = budget_text(budget); !text.empty()) {
        recipe.text += fmt::format("budget: {{{}}}   # for the whole robot\n", text);
    }
    recipe.text +=
        fmt::format("guarantee: outer\noutputs:\n  - {}: {{file: {}}}\n", writer->info.name, quoted(recipe.output));
    return recipe;
}

} // namespace foam::inline recipe
