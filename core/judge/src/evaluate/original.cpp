// From a file to the solids of its links.
#include <foam/base/file.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/recipe/internal/glob.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline judge {
namespace {

/// Leaves out the links that no glob matches.
void choose(Recipe& recipe, const Robot& robot, const std::vector<std::string>& globs) {
    for (const std::string& glob : globs) {
        if (std::none_of(robot.links.begin(), robot.links.end(),
                         [&](const Link& link) { return glob == link.name || glob_matches(glob, link.name); })) {
            throw Error(ErrorCode::usage, fmt::format("'{}' names no link of {}", glob, robot.file.string()));
        }
    }
    for (const Link& link : robot.links) {
        const bool chosen = globs.empty() || std::any_of(globs.begin(), globs.end(), [&](const std::string& glob) {
                                return glob == link.name || glob_matches(glob, link.name);
                            });
        if (!chosen) {
            LinkOverride& left_out = recipe.links.emplace_back();
            left_out.glob = glob_of_name(link.name);
            left_out.skip = true;
        }
    }
}

} // namespace

Original load_original(const std::filesystem::path& file, const Registry& registry,
                       const std::vector<std::string>& links, const MeshUnit& unit, CoveredGeometry geometry,
                       const std::vector<std::filesystem::path>& package_path) {
    Recipe recipe;
    for (const std::filesystem::path& folder : package_path) {
        recipe.package_path.push_back(std::filesystem::absolute(folder).string());
    }
    recipe.mesh_unit = unit;
    recipe.cover = geometry;
    const std::string reference = std::filesystem::absolute(file).string();
    (registry.find_for_extension(StageKind::mesh_loader, extension_of(file)) ? recipe.mesh : recipe.urdf) = {reference};
    const RunOptions options;
    Journal journal(nullptr);
    const Cache cache({});
    const Workspace workspace{recipe, registry, options, journal, cache};
    const Input input = load_input(workspace);
    choose(recipe, *input.robot, links);

    Original result;
    result.file = file;
    result.robot = input.robot;
    result.geometry = geometry;
    result.collision_only = input.collision_only;
    std::vector<InputFile> files;
    const std::vector<LinkWork> work = load_links(workspace, *input.robot, files);
    std::vector<const LinkWork*> chosen;
    for (const LinkWork& link : work) {
        if (!link.recipe.skip) {
            chosen.push_back(&link);
        }
    }
    result.links.resize(chosen.size());
    parallel_for(chosen.size(), [&](std::size_t i) {
        if (chosen[i]->error) {
            throw Error(*chosen[i]->error);
        }
        result.links[i] = {chosen[i]->link->name, solid_of(*chosen[i])};
    });
    if (result.links.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: no link has {}: there is nothing to judge spheres by",
                                                  file.string(), to_string(geometry)));
    }
    for (const Finding& finding : journal.findings()) {
        if (finding.severity >= Severity::warning) {
            result.notes.push_back(finding.message);
        }
    }
    return result;
}

} // namespace foam::judge
