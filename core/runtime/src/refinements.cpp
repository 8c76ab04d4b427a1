#include "refinements.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <cmath>

namespace foam::inline runtime {
namespace {

RefinementGoal goal_of(const Workspace& workspace, const ShapeWork& work) {
    return {.guarantee = workspace.recipe.guarantee,
            .objective = work.objective,
            .max_protrusion = work.max_protrusion,
            .clip = work.clip};
}

SphereTree refined_by(const Workspace& workspace, ShapeWork& work, RefinementWork& refinement, SphereTree tree,
                      std::size_t most) {
    const std::string& stage = refinement.call.stage;
    StageContext context(workspace.journal, work.link, stage, derive_seed(workspace.recipe.seed, stage + work.content),
                         [&workspace] { return workspace.ended(); });
    const StopScope scope(workspace.request());
    const ActivityScope activity(place_of(stage, work.link, work.input), CrashRemedy::isolate_stage);
    const double begin = workspace.journal.seconds();
    try {
        SphereTree result = refinement.refinement->refine(tree, most, context);
        check_tree(result, most, "refiner");
        tree = std::move(result);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) {
            throw described(std::current_exception(), stage, work.link, work.input);
        }
    } catch (...) {
        throw described(std::current_exception(), stage, work.link, work.input);
    }
    const std::scoped_lock lock(work.refinements->mutex);
    refinement.report.seconds += workspace.journal.seconds() - begin;
    return tree;
}

} // namespace

void check_tree(const SphereTree& tree, std::optional<std::size_t> most, std::string_view kind) {
    const auto broken = [kind](const std::string& what) {
        throw Error(ErrorCode::plugin, fmt::format("the {} broke its contract: {}", kind, what));
    };
    if (tree.levels.empty() || tree.finest().empty()) {
        broken("it returned no spheres");
    }
    if (most && tree.finest().size() > *most) {
        broken(fmt::format("it returned {} spheres where at most {} were requested", tree.finest().size(),
                           *most));
    }
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        const SphereTree::Level& level = tree.levels[l];
        for (const Sphere& sphere : level.spheres) {
            if (!is_finite(sphere.center) || !std::isfinite(sphere.radius) || sphere.radius < 0) {
                broken("a sphere is not finite or has a negative radius");
            }
        }
        if (l == 0 ? !level.parents.empty() : level.parents.size() != level.spheres.size()) {
            broken(
                fmt::format("level {} has {} spheres and {} parents", l, level.spheres.size(), level.parents.size()));
        }
        for (const std::uint32_t parent : level.parents) {
            if (parent >= tree.levels[l - 1].spheres.size()) {
                broken(fmt::format("a parent index of level {} is out of range", l));
            }
        }
    }
}

void begin_refinements(const Workspace& workspace, ShapeWork& work) {
    work.refinements = std::make_unique<Refinements>();
    for (const StageCall& call : work.refiners) {
        RefinementWork& refinement = work.refinements->list.emplace_back();
        refinement.call = call;
        refinement.adds_spheres = workspace.registry.find(call.stage)->info.adds_spheres;
        refinement.report.stage = call.stage;
        refinement.refiner = workspace.registry.make<Refiner>(call.stage, call.given);
        refinement.refinement = refinement.refiner->begin(*work.shape, goal_of(workspace, work));
        if (!refinement.refinement) {
            throw Error(ErrorCode::plugin,
                        fmt::format("the refiner {} broke its contract: it began no refinement", call.stage));
        }
    }
}

SphereTree refined(const Workspace& workspace, ShapeWork& work, SphereTree tree, std::size_t most, Refiners which) {
    for (RefinementWork& refinement : work.refinements->list) {
        if (which == Refiners::all || !refinement.adds_spheres) {
            tree = refined_by(workspace, work, refinement, std::move(tree), most);
        }
    }
    return tree;
}

} // namespace foam::runtime
