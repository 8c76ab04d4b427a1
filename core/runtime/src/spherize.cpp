#include <foam/runtime/internal/spherize.hpp>

#include "budget.hpp"
#include "shapes.hpp"

#include <foam/runtime/internal/cover.hpp>

namespace foam::inline runtime {
namespace {

SphereTree moved(SphereTree tree, const Pose& pose) {
    for (SphereTree::Level& level : tree.levels) {
        for (Sphere& sphere : level.spheres) {
            sphere.center = pose * sphere.center;
        }
    }
    return tree;
}

/// Makes a shape fail with guarantee inner if none of its spheres fits into it.
void require_inside(const Workspace& workspace, ShapeWork& work, std::size_t count) {
    if (workspace.recipe.guarantee != Guarantee::inner || work.error) {
        return;
    }
    try {
        require_room(work.shape->original(), work.known.trees.at(count));
    } catch (...) {
        work.error.emplace(described(std::current_exception(), work.spherizer.stage, work.link, work.input));
    }
}

} // namespace

SpherizedLinks spherize_links(const Workspace& workspace, std::vector<LinkWork>& links, ReferencePose* pose) {
    std::vector<Group> groups = make_groups(workspace, links);
    std::vector<ShapeWork> shapes = distinct_shapes(workspace, links, groups);
    for_each_shape(shapes, [&](std::size_t s) {
        const std::string place = place_of("geometry", shapes[s].link, shapes[s].input);
        const ActivityScope activity(place, CrashRemedy::isolate_stage);
        try {
            build_shape(workspace, links, groups, shapes[s]);
        } catch (...) {
            workspace.limits->interrupted_at(place);
            throw described(std::current_exception(), "geometry", shapes[s].link, shapes[s].input);
        }
    });
    const ChosenCounts chosen = choose_counts(workspace, links, shapes, groups, pose);
    const std::vector<std::size_t>& counts = chosen.of_group;
    std::vector<Group> done;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        ShapeWork& work = shapes[groups[g].shape];
        LinkWork& link = links[groups[g].link];
        require_inside(workspace, work, counts[g]);
        link.report.stages.push_back(work.report);
        if (work.refinements) {
            for (const RefinementWork& refinement : work.refinements->list) {
                link.report.stages.push_back(refinement.report);
                link.report.stages.back().cached = work.report.cached;
            }
        }
        for (std::size_t i = link.report.stages.size() - 1 - work.refiners.size(); i < link.report.stages.size(); ++i) {
            link.report.stages[i].input = link.elements[groups[g].elements.front()].geometry;
        }
        if (work.error) {
            if (!link.error) {
                link.error.emplace(*work.error);
            }
            continue;
        }
        groups[g].tree = moved(work.known.trees.at(counts[g]), groups[g].frame);
        if (groups[g].elements.size() == 1 && groups[g].frame == Pose{}) {
            groups[g].solid = work.original; // the group has the frame of the shape
        }
        link.report.stages.back().output = digest_of_content(groups[g].tree);
        done.push_back(std::move(groups[g]));
    }
    std::erase_if(done, [&](const Group& group) { return links[group.link].error.has_value(); });
    return {std::move(done), chosen.cut};
}

} // namespace foam::runtime
