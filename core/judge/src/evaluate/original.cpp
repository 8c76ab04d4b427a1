// From a file to the solids of its links.
#include "evaluate/original.hpp"

#include <foam/base/file.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline judge {
namespace {

/// Returns the solids of the links that were loaded. Throws the error of a link that could not be.
std::vector<OriginalLink> solids_of(const std::vector<LoadedLink>& links) {
    std::vector<const LoadedLink*> loaded;
    for (const LoadedLink& link : links) {
        if (!link.elements.empty()) {
            loaded.push_back(&link);
        }
    }
    std::vector<OriginalLink> solids(loaded.size());
    parallel_for(loaded.size(), [&](std::size_t i) {
        if (loaded[i]->error) {
            throw Error(*loaded[i]->error);
        }
        solids[i] = {loaded[i]->link->name, solid_of(*loaded[i])};
    });
    return solids;
}

std::vector<std::string> warnings_of(const Journal& journal) {
    std::vector<std::string> warnings;
    for (const Finding& finding : journal.findings()) {
        if (finding.severity >= Severity::warning) {
            warnings.push_back(finding.message);
        }
    }
    return warnings;
}

} // namespace

std::shared_ptr<const LoadedInput> read_original(const std::filesystem::path& file, const Registry& registry,
                                                 const OriginalOptions& options) {
    const bool mesh = registry.find_for_extension(StageKind::mesh_loader, extension_of(file)) != nullptr;
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& folder : options.package_path) {
        folders.push_back(package_entry(folder.string(), std::filesystem::current_path()));
    }
    Reading reading{.unit = options.unit, .name = options.name};
    reading.resources = reading.resources.preceded_by(std::move(folders));
    const RunOptions run;
    Journal journal(nullptr);
    return std::make_shared<const LoadedInput>(read_input({registry, run, journal}, reading,
                                                          std::filesystem::absolute(file),
                                                          mesh ? InputKind::mesh : InputKind::robot, file.string()));
}

Original original_of(std::shared_ptr<const LoadedInput> loaded, const Registry& registry,
                     const OriginalOptions& options) {
    const RobotChoices choices{.keep = options.links, .skip = options.skip, .locks = options.held};
    require_choices(choices, *loaded->robot);
    Original result;
    result.file = loaded->chosen;
    result.geometry = options.geometry;
    result.collision_only = uncovered_links(*loaded->robot, options.geometry);
    result.robot = std::make_shared<const Robot>(
        with_joints_held(with_covered_geometry(*loaded->robot, options.geometry), options.held));
    const RunOptions run;
    Journal journal(nullptr);
    journal.repeat(loaded->log, "", loaded->report.stage);
    LoadedLinks links = load_links(
        {registry, run, journal}, {}, *result.robot, [&](const Link& link) { return is_chosen(choices, link.name); },
        loaded->meshes);
    for (LoadedLink& link : links.links) {
        link.covers = options.covers;
    }
    result.links = solids_of(links.links);
    if (result.links.empty()) {
        refuse_without_geometry(loaded->chosen, *result.robot, options.geometry, "to judge spheres by");
    }
    result.notes = warnings_of(journal);
    result.loaded = std::move(loaded);
    if (options.keep_meshes) {
        auto whole = std::make_shared<LoadedInput>(*result.loaded);
        whole->meshes = std::move(links.meshes);
        result.loaded = std::move(whole);
    }
    return result;
}

Original load_original(const std::filesystem::path& file, const Registry& registry, const OriginalOptions& options) {
    return original_of(read_original(file, registry, options), registry, options);
}

} // namespace foam::judge
