#include <foam/runtime/internal/input.hpp>

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
        folders.push_back(package_entry(folder, recipe_folder(recipe)));
    }
    return ResourceResolver::from_environment().preceded_by(std::move(folders));
}

/// Takes an input that was read before; the log of its loader is repeated.
LoadedInput taken(const Workspace& workspace, LoadedInput input) {
    if (!input.report.stage.empty()) {
        input.report.seconds = 0;
        workspace.journal.repeat(input.log, "", input.report.stage);
        workspace.journal.finished("", input.report);
    }
    return input;
}

/// Reads the first candidate that resolves.
LoadedInput read_candidate(const Workspace& workspace) {
    std::string chosen;
    const fs::path file = resolve_input(workspace.recipe, &chosen).path;
    return read_input(workspace, reading_of(workspace), file,
                      workspace.recipe.urdf.empty() ? InputKind::mesh : InputKind::robot, chosen);
}

} // namespace

Reading reading_of(const Workspace& workspace) {
    const Recipe& recipe = workspace.recipe;
    return {.resources = resolver_of(recipe),
            .unit = recipe.mesh_unit,
            .preferred_loader = recipe.preferred_loader,
            .call = [&recipe](const std::string& loader) { return recipe.loader_call(loader); },
            .name = workspace.options.input_name};
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
    const auto& given = workspace.options.input;
    LoadedInput loaded = given ? taken(workspace, *given) : read_candidate(workspace);
    const CoveredGeometry cover = workspace.recipe.cover.value_or(CoveredGeometry::collision);
    Input input;
    input.chosen = std::move(loaded.chosen);
    input.file = std::move(loaded.file);
    input.digest = loaded.digest;
    input.bytes = loaded.bytes;
    for (const fs::path& file : loaded.robot->further_files) {
        const fs::path seen = file.lexically_relative(fs::absolute(loaded.robot->file).parent_path().lexically_normal());
        const DigestedFile read = digest_of_file(file);
        input.further.push_back({seen.empty() ? file.string() : seen.generic_string(), file, read.digest, read.bytes});
    }
    input.report = std::move(loaded.report);
    input.report.output = digest_of_content(*loaded.robot);
    input.collision_only = uncovered_links(*loaded.robot, cover);
    input.robot = cover == CoveredGeometry::collision
                      ? loaded.robot
                      : std::make_shared<const Robot>(with_covered_geometry(*loaded.robot, cover));
    return input;
}

} // namespace foam::inline runtime
