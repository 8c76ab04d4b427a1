#include <foam/runtime/internal/links.hpp>

#include "allocate/budget.hpp"
#include "finish/finish.hpp"
#include "input/shapes.hpp"

#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

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

/// Returns the volume or the area of a shape's geometry by which the recipe divides its excess volume.
double divisor(Share share, const ShapeWork& work) {
    return share == Share::even ? work.original->volume() : work.original->area();
}

/// Sets the weights of the groups in the allocation as the recipe's rule demands.
void weigh(const Recipe& recipe, std::vector<LinkWork>& links, const std::vector<ShapeWork>& shapes,
           std::vector<Group>& groups) {
    const Share share = recipe.budget_share.value_or(Share::volume);
    if (share == Share::volume) {
        return;
    }
    double sum = 0;
    for (const Group& group : groups) {
        sum += shapes[group.shape].error ? 0 : divisor(share, shapes[group.shape]);
    }
    for (Group& group : groups) {
        const ShapeWork& work = shapes[group.shape];
        if (work.error) {
            continue;
        }
        if (const double own = divisor(share, work); own > 0) {
            group.weight *= sum / static_cast<double>(groups.size()) / own;
        } else if (LinkWork& link = links[group.link]; !link.error) {
            link.error.emplace(
                ErrorCode::recipe,
                fmt::format("link '{}': its geometry has no {} to compare with; remedy: budget: {{share: "
                            "{}}}",
                            link.link->name, share == Share::even ? "volume" : "area",
                            share == Share::even ? "protrusion" : "volume"));
        }
    }
}

/// Returns the recipe with a budget that is smaller by the spheres that links keep.
Recipe without_kept(const Workspace& workspace, const std::vector<LinkWork>& links, const std::vector<Group>& groups,
                    const std::vector<Group>& covered) {
    Recipe rest = workspace.recipe;
    const std::size_t kept = kept_spheres(links, groups) + kept_spheres(links, covered);
    if (kept == 0 || !total_of(rest)) {
        return rest;
    }
    if (rest.budget_cost) {
        const double price = static_cast<double>(kept) * rest.costs.of_kind[0];
        *rest.budget_cost -= price;
        if (*rest.budget_cost <= 0) {
            throw Error(ErrorCode::recipe, fmt::format("budget.cost: the {} spheres that links keep cost {:g}; remedy: "
                                                       "raise the budget, or keep fewer",
                                                       kept, price));
        }
        return rest;
    }
    if (*rest.budget_spheres < kept + groups.size()) {
        throw Error(ErrorCode::recipe,
                    fmt::format("budget.spheres: {} is not enough: links keep {} spheres, and {} need others; remedy: "
                                "raise the budget, or keep fewer",
                                *rest.budget_spheres, kept, groups.size()));
    }
    workspace.journal.finding(
        {Severity::info, "", "",
         fmt::format("{} of the budget of {} spheres are kept as the recipe gives them", kept, *rest.budget_spheres)});
    *rest.budget_spheres -= kept;
    return rest;
}

} // namespace

/// Returns the result of the group's shape where the group is, in the frame of its link.
static SphereTree placed(SphereTree tree, const Group& group) {
    for (SphereTree::Level& level : tree.levels) {
        level.elements = imaged(std::move(level.elements), group.from_shape);
    }
    return moved(std::move(tree), group.frame);
}

/// Throws Error(plugin) if the geometry of a shape is not what was read: what is proved would be something else.
static void require_as_read(const std::vector<LinkWork>& links, const std::vector<Group>& groups,
                            const ShapeWork& work) {
    bool changed = !work.error && work.original && digest_of_content(work.original->surface()) != work.built;
    for (const std::size_t g : work.groups) {
        const std::vector<CollisionElement>& elements = links[groups[g].link].elements;
        changed = changed || std::any_of(groups[g].elements.begin(), groups[g].elements.end(), [&](std::size_t e) {
                      return elements[e].raw && digest_of_content(*elements[e].raw) != elements[e].read;
                  });
    }
    if (changed) {
        throw Error(ErrorCode::plugin,
                    fmt::format("stage '{}', link '{}', input '{}': the geometry is not what was read any more: this "
                                "stage or a filter has written into it; nothing can be proved; remedy: correct the "
                                "plugin",
                                work.spherizer.stage, work.link, work.input));
    }
}

SpherizedLinks spherize_links(const Workspace& workspace, std::vector<LinkWork>& links, ReferencePose* pose,
                              RandomPoses* poses) {
    std::vector<Group> groups = make_groups(workspace, links);
    std::vector<Group> done = take_covered_groups(workspace, links, groups);
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
    weigh(workspace.recipe, links, shapes, groups);
    const Recipe rest = without_kept(workspace, links, groups, done);
    const ChosenCounts chosen = choose_counts(workspace.with(rest), links, shapes, groups, pose, poses);
    const std::vector<std::size_t>& counts = chosen.of_group;
    { // after a stop request, too
        const StopScope scope(workspace.in(Phase::finishing).request());
        parallel_for(shapes.size(), [&](std::size_t s) { require_as_read(links, groups, shapes[s]); });
    }
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
        groups[g].tree = placed(work.known.trees.at(counts[g]), groups[g]);
        if (groups[g].elements.size() == 1 && groups[g].frame == Pose{} && groups[g].from_shape == Likeness{} &&
            !groups[g].uncovered) {
            groups[g].solid = work.unfilled; // the group has the frame of the shape
            groups[g].filled = work.original;
        }
        link.report.stages.back().output = digest_of_content(groups[g].tree);
        done.push_back(std::move(groups[g]));
    }
    std::erase_if(done, [&](const Group& group) { return links[group.link].error.has_value(); });
    std::stable_sort(done.begin(), done.end(), [](const Group& a, const Group& b) { return a.link < b.link; });
    return {std::move(done), chosen.cut};
}

} // namespace foam::inline runtime
