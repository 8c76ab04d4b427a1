#include "write/report.hpp"

#include <foam/report/internal/report.hpp>
#include <foam/runtime/internal/cover.hpp>

namespace foam::inline runtime {
namespace {

using report::Report;
using report::ReportLink;

/// Returns the levels over all groups of the link. A group with fewer levels shows its finest in the others.
std::vector<Elements> levels_of(const SphereModel& model, const std::string& link) {
    std::size_t count = 0;
    for (const SphereGroup& group : model.groups) {
        count = group.link == link ? std::max(count, group.tree.levels.size()) : count;
    }
    std::vector<Elements> levels(count);
    for (const SphereGroup& group : model.groups) {
        for (std::size_t l = 0; group.link == link && l < count; ++l) {
            levels[l].add(group.tree.levels[std::min(l, group.tree.levels.size() - 1)].elements);
        }
    }
    return levels;
}

ReportLink report_link(const FinishedLink& finished, const SphereModel& model,
                       const std::map<std::string, Pose>& poses) {
    const LinkWork& work = *finished.work;
    ReportLink link;
    link.spherizer = work.recipe.spherizer.stage;
    link.scene.name = work.link->name;
    if (const auto pose = poses.find(link.scene.name); pose != poses.end()) {
        link.scene.pose = pose->second;
    }
    for (std::size_t stage = 0; stage <= work.recipe.filters.size(); ++stage) {
        link.scene.meshes.push_back({stage == 0 ? "original" : work.recipe.filters[stage - 1].stage,
                                     std::make_shared<const Mesh>(link_mesh(work, stage))});
    }
    link.scene.levels = levels_of(model, link.scene.name);
    return link;
}

} // namespace

std::string report_html(const Workspace& workspace, const FinishedModel& finished, const std::string& manifest,
                        const std::string& recipe, const Snapshots& pictures) {
    Report report{.manifest = nlohmann::ordered_json::parse(manifest),
                  .recipe = recipe,
                  .name = finished.model.robot->name,
                  .links = {},
                  .picture = pictures.robot,
                  .files = {}};
    const auto poses = link_poses(*finished.model.robot, workspace.recipe.pose);
    for (const FinishedLink& link : finished.links) {
        report.links.push_back(report_link(link, finished.model, poses));
    }
    for (const auto& file : pictures.files) {
        report.files.push_back(file.string());
    }
    return to_html(report);
}

} // namespace foam::runtime
