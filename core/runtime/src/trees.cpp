#include "trees.hpp"

#include "process/isolated.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/row_cover.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/search/internal/clip.hpp>
#include <foam/search/internal/fit.hpp>

#include <fmt/format.h>

#include <cmath>

namespace foam::inline runtime {
namespace {

/// Checks the contract of a spherizer: finite spheres, at most as many as requested, valid parents.
void check_tree(const SphereTree& tree, const Budget& budget) {
    const auto broken = [](const std::string& what) {
        throw Error(ErrorCode::plugin, "the spherizer broke its contract: " + what);
    };
    if (tree.levels.empty() || tree.finest().empty()) {
        broken("it returned no spheres");
    }
    if (budget.max_spheres && tree.finest().size() > *budget.max_spheres) {
        broken(fmt::format("it returned {} spheres where at most {} were requested", tree.finest().size(),
                           *budget.max_spheres));
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

/// Returns the sphere if the shape is one: no spherizer can do better.
std::optional<Sphere> as_sphere(const Solid& solid) {
    const Solid::Part& part = solid.parts().front();
    if (solid.parts().size() > 1 || !part.primitive || part.primitive->kind != Primitive::Kind::sphere) {
        return {};
    }
    return Sphere{part.pose.translation, part.primitive->radius};
}

/// Replaces the spheres of a cylinder or capsule by a row of equal ones along the axis, in closed form, if that has
/// less excess volume.
void take_better_row(const Workspace& workspace, const ShapeWork& work, std::size_t count, SphereTree& tree) {
    const Recipe& recipe = workspace.recipe;
    if (count == 0 || recipe.guarantee != Guarantee::outer || work.max_protrusion || !work.clip.empty() ||
        tree.levels.size() > 2 || !wants_least_excess(recipe, work)) {
        return;
    }
    const Solid& solid = work.shape->original();
    if (auto row = geometry::row_cover(solid, count);
        row && cost_volume(solid, *row, recipe.guarantee) < cost_volume(solid, tree.finest(), recipe.guarantee)) {
        tree = flat_tree(std::move(*row));
    }
}

/// Fits the finest level with guarantee fitted, whatever stage it is from, because stages give covering spheres.
/// Coarser levels remain bounds of it. In deep trees spheres stay near their parents.
void fit_finest(const Solid& solid, const Budget& budget, SphereTree& tree) {
    SphereTree::Level& finest = tree.levels.back();
    const bool flat = tree.levels.size() <= 2;
    try {
        finest.spheres = fitted::fit(solid, finest.spheres, budget.max_spheres.value_or(finest.spheres.size()),
                                     flat ? fitted::Reach::far : fitted::Reach::near);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) {
            throw;
        }
        return; // the spherizer's spheres remain
    }
    if (tree.levels.size() > 1 && flat) {
        finest.parents.assign(finest.spheres.size(), 0);
    }
}

/// Makes the finest level keep the half-space constraints if it does not, because stages do not know them. Removes
/// coarser levels except the root.
void make_keep_constraints(const Workspace& workspace, const ShapeWork& work, const Budget& budget, SphereTree& tree) {
    const Solid& solid = work.shape->original();
    const bool outer = budget.guarantee == Guarantee::outer;
    if (keep_constraints(solid, outer ? grown_to_cover(solid, tree.finest()) : tree.finest(), work.clip)) {
        return;
    }
    if (outer) {
        const std::size_t count = budget.max_spheres.value_or(tree.finest().size());
        tree = flat_tree(covering_within(solid, tree.finest(), count, work.clip, workspace.recipe.seed));
    } else if (std::vector<Sphere> left = shrunk_within(solid, tree.finest(), work.clip); !left.empty()) {
        tree = flat_tree(std::move(left));
    }
}

/// Runs the spherizer. Returns one checked tree for each budget.
std::vector<SphereTree> run_spherizer(const Workspace& workspace, ShapeWork& work, const std::vector<Budget>& budgets,
                                      StageLog& said) {
    return run_stage(
        workspace, work.spherizer.stage, work.link, work.input, work.content, work.report, [&](StageContext& context) {
            std::vector<SphereTree> made =
                call_spherizer(workspace, work.spherizer, work.stage, work.own ? *work.own : *work.shape, work.frame,
                               budgets, context);
            if (made.size() != budgets.size()) {
                throw Error(ErrorCode::plugin, fmt::format("the spherizer broke its contract: {} trees for {} budgets",
                                                           made.size(), budgets.size()));
            }
            for (std::size_t i = 0; i < made.size(); ++i) {
                check_tree(made[i], budgets[i]);
            }
            if (workspace.recipe.guarantee == Guarantee::fitted) {
                parallel_for(made.size(),
                             [&](std::size_t i) { fit_finest(work.shape->original(), budgets[i], made[i]); });
            }
            if (!work.clip.empty()) {
                parallel_for(made.size(),
                             [&](std::size_t i) { make_keep_constraints(workspace, work, budgets[i], made[i]); });
            }
            said = context.said();
            return made;
        });
}

/// Returns a name for a call, from the keys of the trees that it makes.
std::string call_name(const std::vector<Digest>& keys) {
    Hasher hasher;
    for (const Digest& key : keys) {
        hasher.add(key);
    }
    return hasher.finish();
}

/// Adds the spherizer's log to the run, once per call: by rising count, whatever the cache had, so that the metrics of
/// the same call remain.
void add_words(const Workspace& workspace, ShapeWork& work, const std::map<std::size_t, Cached<SphereTree>>& known) {
    for (const auto& [count, entry] : known) {
        const StageLog& said = entry.said;
        if (said.call.empty()) {
            continue; // no spherizer was called
        }
        if (work.calls.insert(said.call).second) {
            workspace.journal.repeat(said, work.link, work.spherizer.stage);
        }
        work.report.metrics = said.metrics;
    }
}

} // namespace

Digest tree_key(const Workspace& workspace, const ShapeWork& work, std::size_t count) {
    Hasher hasher;
    hasher.add("spherize").add(work.digest).add(work.content).add(workspace.recipe.seed);
    hasher.add(static_cast<std::uint64_t>(count));
    hasher.add(static_cast<std::uint64_t>(workspace.recipe.guarantee));
    if (workspace.recipe.guarantee == Guarantee::fitted) {
        hasher.add(static_cast<std::uint64_t>(fitted::revision));
    }
    return hasher.add(work.max_protrusion.value_or(-1)).finish();
}

void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    std::vector<Budget> budgets;
    std::vector<Digest> keys;
    std::vector<std::size_t> missing;
    std::map<std::size_t, Cached<SphereTree>> known; // by requested count
    const auto sphere = as_sphere(work.shape->original());
    for (const std::size_t count : counts) {
        if (work.known.asked.contains(count)) {
            continue;
        }
        if (sphere) {
            known[count].result = flat_tree({*sphere});
            continue;
        }
        Budget budget;
        budget.guarantee = workspace.recipe.guarantee;
        budget.max_protrusion = work.max_protrusion;
        if (count > 0) {
            budget.max_spheres = count;
        }
        const Digest key = tree_key(workspace, work, count);
        if (auto cached = workspace.cache.tree(key)) {
            known.emplace(count, std::move(*cached));
            continue;
        }
        budgets.push_back(budget);
        keys.push_back(key);
        missing.push_back(count);
    }
    work.report.cached = missing.empty() && (work.report.cached || work.report.seconds == 0);
    if (!missing.empty()) {
        StageLog said;
        std::vector<SphereTree> trees = run_spherizer(workspace, work, budgets, said);
        said.call = call_name(keys);
        work.calls.insert(said.call);          // its findings are in the journal
        const bool whole = !workspace.ended(); // else the stage may have returned early
        for (std::size_t i = 0; i < trees.size(); ++i) {
            if (whole) {
                workspace.cache.put(keys[i], trees[i], said);
            }
            known[missing[i]] = {std::move(trees[i]), said};
        }
    }
    add_words(workspace, work, known);
    // By count, whatever the cache had: of two trees of one size, the one with the smaller requested count stays.
    for (auto& [count, entry] : known) {
        take_better_row(workspace, work, count, entry.result);
        const std::size_t got = entry.result.finest().size();
        work.known.asked[count] = got;
        work.known.trees.try_emplace(got, std::move(entry.result));
    }
}

} // namespace foam::runtime
