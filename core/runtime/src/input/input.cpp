#include <foam/runtime/internal/input.hpp>

#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

fs::path recipe_folder(const Recipe& recipe) {
    return recipe.file.empty() ? fs::current_path() : fs::absolute(recipe.file).parent_path();
}

/// Returns a resolver with the recipe's package path, followed by the environment's.
ResourceResolver resolver_of(const Recipe& recipe) {
    if (recipe.package_path.empty()) {
        return ResourceResolver::from_environment();
    }
    std::vector<fs::path> folders;
    for (const std::string& folder : recipe.package_path) {
        folders.push_back(recipe_folder(recipe) / folder);
    }
    return ResourceResolver::from_environment().preceded_by(std::move(folders));
}

/// Returns a robot with one link whose collision geometry is the mesh.
Robot robot_of_mesh(const fs::path& file, const std::string& reference, double scale) {
    Robot robot;
    robot.name = file.stem().string();
    robot.root = robot.name;
    robot.file = file;
    Link link;
    link.name = robot.name;
    GeometryElement element;
    element.geometry = MeshReference{reference, file, {scale, scale, scale}};
    link.collisions = {element};
    link.visuals = {element};
    robot.links = {link};
    return robot;
}

/// Returns the name of a single mesh in outputs: a URI as written; of a path only the file's name, so that the same
/// recipe gives the same bytes in every folder.
std::string portable_reference(const Input& input) {
    return input.chosen.find("://") != std::string::npos ? input.chosen : input.file.filename().string();
}

/// Returns the value of a loader's parameter max_bytes; nothing if it has none.
std::optional<std::int64_t> max_bytes(const Recipe& recipe, const RegisteredStage& loader) {
    const auto given = recipe.loader_call(loader.info.name).given;
    for (const Parameter& parameter : loader.info.parameters) {
        if (parameter.name == "max_bytes" && parameter.type == Parameter::Type::integer) {
            const auto value = given.find(parameter.name);
            return std::get<std::int64_t>(value == given.end() ? parameter.default_value : value->second);
        }
    }
    return std::nullopt;
}

} // namespace

const RegisteredStage* mesh_loader_of(const Workspace& workspace, const fs::path& file) {
    return workspace.registry.find_for_extension(StageKind::mesh_loader, extension_of(file),
                                                 workspace.recipe.preferred_loader);
}

DigestedFile digest_of_mesh_file(const Workspace& workspace, const fs::path& file) {
    const RegisteredStage* loader = mesh_loader_of(workspace, file);
    const auto limit = loader ? max_bytes(workspace.recipe, *loader) : std::nullopt;
    return limit ? digest_of_file(file, static_cast<std::uintmax_t>(*limit),
                                  fmt::format("simplify the mesh, or raise max_bytes of {}", loader->info.name))
                 : digest_of_file(file);
}

bool input_resolves(const Recipe& recipe) {
    const ResourceResolver resolver = resolver_of(recipe);
    const auto& candidates = recipe.urdf.empty() ? recipe.mesh : recipe.urdf;
    return std::any_of(candidates.begin(), candidates.end(), [&](const std::string& candidate) {
        return resolver.resolve(candidate, recipe_folder(recipe)).found();
    });
}

ResolvedResource resolve_input(const Recipe& recipe, std::string* chosen) {
    const ResourceResolver resolver = resolver_of(recipe);
    ResolvedResource all;
    const auto& candidates = recipe.urdf.empty() ? recipe.mesh : recipe.urdf;
    for (const std::string& candidate : candidates) {
        ResolvedResource found = resolver.resolve(candidate, recipe_folder(recipe));
        if (found.found()) {
            if (chosen) {
                *chosen = candidate;
            }
            return found;
        }
        all.tried.insert(all.tried.end(), found.tried.begin(), found.tried.end());
    }
    std::string message = recipe.input_where.file.empty() ? "" : recipe.input_where.text() + ": ";
    message += fmt::format("none of the inputs [{}] exists. Looked at:", fmt::join(candidates, ", "));
    for (const fs::path& place : all.tried) {
        std::error_code error;
        message += "\n  " + place.string() + (fs::exists(place, error) ? " (it is no regular file)" : "");
    }
    message += "\nremedy: correct the path, or set FOAM_PACKAGE_PATH to the folder that holds the package";
    throw Error(ErrorCode::input, message);
}

Input load_input(const Workspace& workspace) {
    Input input;
    input.file = resolve_input(workspace.recipe, &input.chosen).path;
    const bool mesh = workspace.recipe.urdf.empty();
    if (const std::string why = why_refused(workspace.recipe.mesh_unit, input.file,
                                            mesh ? InputKind::mesh : InputKind::robot, workspace.registry,
                                            workspace.recipe.preferred_loader);
        !why.empty()) {
        throw Error(ErrorCode::usage, why);
    }
    input.report.input = input.file.filename().string();
    if (mesh) {
        const DigestedFile digested = digest_of_mesh_file(workspace, input.file);
        input.digest = digested.digest;
        input.bytes = digested.bytes;
        input.robot = std::make_shared<const Robot>(
            robot_of_mesh(input.file, portable_reference(input), workspace.recipe.mesh_unit.factor()));
        input.report.output = digest_of_content(*input.robot);
        return input;
    }
    const std::string text = read_file(input.file, most_robot_bytes);
    input.digest = digest_of(text);
    input.bytes = text.size();
    const RegisteredStage* loader = workspace.registry.find_for_extension(
        StageKind::robot_loader, extension_of(input.file), workspace.recipe.preferred_loader);
    if (!loader) {
        loader = workspace.registry.find_for_extension(StageKind::robot_loader, "urdf");
    }
    if (!loader) {
        throw Error(ErrorCode::plugin, "no plugin can read URDF files; `foam plugins --why` shows which plugins were "
                                       "loaded, and why others were not");
    }
    Robot robot = run_stage(
        workspace, loader->info.name, "", input.file.string(), input.digest, input.report, [&](Context& context) {
            const auto stage = workspace.registry.make<RobotLoader>(
                loader->info.name, workspace.recipe.loader_call(loader->info.name).given);
            return stage->load(text, input.file, resolver_of(workspace.recipe), context);
        });
    input.report.output = digest_of_content(robot);
    const CoveredGeometry cover = workspace.recipe.cover.value_or(CoveredGeometry::collision);
    input.collision_only = uncovered_links(robot, cover);
    input.robot = std::make_shared<const Robot>(with_covered_geometry(std::move(robot), cover));
    return input;
}

} // namespace foam::runtime
