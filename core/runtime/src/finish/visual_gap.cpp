#include "finish/visual_gap.hpp"

#include <foam/geometry/measure.hpp>

#include <algorithm>

namespace foam::inline runtime {
namespace {

/// Returns the robot with the links that `keep` accepts, and their visual geometry as what is to be loaded.
template <class Keep> Robot visual_robot(const Robot& robot, Keep keep) {
    Robot visual = with_covered_geometry(robot, CoveredGeometry::visual);
    std::erase_if(visual.links, [&](const Link& link) { return link.visuals.empty() || !keep(link.name); });
    return visual;
}

/// Loads meshes without a word: what loaders say of visual geometry does not concern the spheres.
std::vector<LinkWork> loaded_in_silence(const Workspace& workspace, const Robot& visual) {
    Journal quiet(nullptr);
    Workspace loading{workspace.recipe, workspace.registry, workspace.options, quiet, workspace.cache};
    loading.limits = workspace.limits;
    loading.phase = workspace.phase;
    std::vector<InputFile> files;
    return load_links(loading, visual, files);
}

} // namespace

void measure_visual_gaps(const Workspace& workspace, const FinishedModel& finished, std::vector<LinkWork>& links) {
    if (workspace.recipe.cover.value_or(CoveredGeometry::collision) != CoveredGeometry::collision ||
        !workspace.recipe.mesh.empty()) {
        return;
    }
    const auto find = [&](const std::string& name) {
        return std::find_if(finished.links.begin(), finished.links.end(),
                            [&](const FinishedLink& link) { return link.work->link->name == name; });
    };
    const Robot visual = visual_robot(*finished.model.robot,
                                      [&](const std::string& name) { return find(name) != finished.links.end(); });
    std::vector<LinkWork> loaded = loaded_in_silence(workspace, visual);
    const StopScope scope(workspace.request());
    parallel_for(loaded.size(), [&](std::size_t i) {
        const FinishedLink& link = *find(loaded[i].link->name);
        VisualGap& gap = links[static_cast<std::size_t>(link.work - links.data())].report.visual_gap.emplace();
        if (loaded[i].error) {
            gap.unknown = loaded[i].error->what();
            return;
        }
        const Certificate certificate = certify(*solid_of(loaded[i]), link.elements);
        gap.length = certificate.holds ? 0 : certificate.growth;
    });
}

} // namespace foam::inline runtime
