#include "allocate/exploration.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {
namespace {

RefinementGoal goal_of(const Workspace& workspace, const ShapeWork& work) {
    return {.guarantee = workspace.recipe.guarantee,
            .objective = work.objective,
            .max_protrusion = work.max_protrusion,
            .clip = work.clip};
}

/// Throws Error(recipe) for elements that the refiner does not know: it might drop them.
void require_known(const Workspace& workspace, const RefinementWork& refinement, const SphereTree& tree) {
    const std::vector<Element::Kind>& known = workspace.registry.find(refinement.call.stage)->info.kinds;
    for (const Element& element : tree.levels.back().elements.shaped()) {
        if (!knows_all(known, {element.kind})) {
            throw Error(ErrorCode::recipe, fmt::format("it refines {} alone, not {}; remedy: delete it",
                                                       words_of(known), noun_of(element.kind, 2)));
        }
    }
}

SphereTree refined_by(const Workspace& workspace, ShapeWork& work, RefinementWork& refinement, SphereTree tree,
                      std::size_t most) {
    const std::string& stage = refinement.call.stage;
    StageContext context(workspace.journal, work.link, stage, derive_seed(workspace.recipe.seed, stage + work.content),
                         [&workspace] { return workspace.ended(); });
    const StopScope scope(workspace.request());
    const ActivityScope activity(place_of(stage, work.link, work.input), CrashRemedy::isolate_stage);
    const double begin = workspace.journal.seconds();
    const WorkingFolder folder;
    try {
        require_known(workspace, refinement, tree);
        SphereTree result = refinement.refinement->refine(tree, most, context);
        Budget limit;
        limit.max_spheres = most;
        check_tree(result, limit, workspace.registry.find(stage)->info.kinds, work.shape->original().bounds(),
                   "refiner");
        folder.require();
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

namespace {

[[noreturn]] void broken(std::string_view stage_kind, const std::string& what) {
    throw Error(ErrorCode::plugin, fmt::format("the {} broke its contract: {}", stage_kind, what));
}

void check_elements(const SphereTree::Level& level, const std::vector<Element::Kind>& kinds,
                    std::string_view stage_kind) {
    for (const Sphere& sphere : level.elements.spheres()) {
        if (!is_finite(sphere.center) || !std::isfinite(sphere.radius) || sphere.radius < 0) {
            broken(stage_kind, "a sphere is not finite or has a negative radius");
        }
    }
    for (const Element& element : level.elements.shaped()) {
        if (std::find(kinds.begin(), kinds.end(), element.kind) == kinds.end()) {
            broken(stage_kind, fmt::format("it returned {}, which its StageInfo::kinds lacks",
                                           with_article(noun_of(element.kind, 1))));
        }
        if (!is_valid(element)) {
            broken(stage_kind, fmt::format("{} is not finite, has no volume or a rotation that is none",
                                           with_article(noun_of(element.kind, 1))));
        }
    }
}

/// Returns how far an element reaches from a point, roughly.
double reach_from(const Vec3& point, const Element& element) {
    double reach = distance(element.pose.translation, point) + norm(element.half) + element.radius;
    if (element.hull) {
        for (const Vec3& v : element.hull->surface.vertices) {
            reach = std::max(reach, distance(element.pose.translation, point) + norm(v));
        }
    }
    return reach;
}

/// Numbers that are out of all proportion to the shape have no accuracy left beside it.
void check_reach(const SphereTree::Level& level, const Box& bounds, std::string_view stage_kind) {
    constexpr double proportion = 1e6;
    const Vec3 middle = bounds.center();
    const auto check = [&](const std::string& noun, double reach) {
        if (!(reach <= proportion * bounds.diagonal())) {
            broken(stage_kind, fmt::format("{} reaches more than a million times as far as the shape, which is {:g} m "
                                           "long",
                                           noun, bounds.diagonal()));
        }
    };
    for (const Sphere& sphere : level.elements.spheres()) {
        check("a sphere", distance(sphere.center, middle) + sphere.radius);
    }
    for (const Element& element : level.elements.shaped()) {
        check(with_article(noun_of(element.kind, 1)), reach_from(middle, element));
    }
}

void check_parents(const SphereTree& tree, std::size_t l, std::string_view stage_kind) {
    const SphereTree::Level& level = tree.levels[l];
    if (l == 0 ? !level.parents.empty() : level.parents.size() != level.elements.size()) {
        broken(stage_kind, fmt::format("level {} has {} {} and {} parents", l, level.elements.size(),
                                       level.elements.are_spheres() ? "spheres" : "elements", level.parents.size()));
    }
    for (const std::uint32_t parent : level.parents) {
        if (parent >= tree.levels[l - 1].elements.size()) {
            broken(stage_kind, fmt::format("a parent index of level {} is out of range", l));
        }
    }
}

} // namespace

void check_tree(const SphereTree& tree, const Budget& budget, const std::vector<Element::Kind>& kinds,
                const Box& bounds, std::string_view stage_kind) {
    if (tree.levels.empty() || tree.elements().empty()) {
        broken(stage_kind, "it returned no spheres");
    }
    const Elements& finest = tree.elements();
    const char* noun = finest.are_spheres() ? "spheres" : "elements";
    if (budget.max_spheres && finest.size() > *budget.max_spheres) {
        broken(stage_kind, fmt::format("it returned {} {} where at most {} were requested", finest.size(), noun,
                                       *budget.max_spheres));
    }
    constexpr double rounding = 1e-9;
    if (const double price = price_of(finest, budget.cost);
        budget.max_cost && finest.size() > 1 && price > *budget.max_cost * (1 + rounding)) {
        broken(stage_kind, fmt::format("it returned {} that cost {}, where at most {} was requested", noun, price,
                                       *budget.max_cost));
    }
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        check_elements(tree.levels[l], kinds, stage_kind);
        check_reach(tree.levels[l], bounds, stage_kind);
        check_parents(tree, l, stage_kind);
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

} // namespace foam::inline runtime
