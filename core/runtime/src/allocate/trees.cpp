#include "allocate/exploration.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/solid_of_balls.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {
namespace {

/// Runs the spherizer. Returns one checked tree for each budget.
std::vector<SphereTree> run_spherizer(const Workspace& workspace, ShapeWork& work, const std::vector<Budget>& budgets,
                                      StageLog& log) {
    return run_stage(
        workspace, work.spherizer.stage, work.link, work.input, work.content, work.report, [&](StageContext& context) {
            std::vector<SphereTree> made =
                call_spherizer(workspace, work.spherizer, work.search, work.own ? *work.own : *work.shape, work.frame,
                               budgets, context);
            if (made.size() != budgets.size()) {
                throw Error(ErrorCode::plugin, fmt::format("the spherizer broke its contract: {} trees for {} budgets",
                                                           made.size(), budgets.size()));
            }
            for (std::size_t i = 0; i < made.size(); ++i) {
                check_tree(made[i], budgets[i], work.kinds, work.shape->original().bounds(), "spherizer");
            }
            log = context.kept_log();
            return made;
        });
}

/// Returns the budget of a shape; 0: none.
Budget budget_of(const Recipe& recipe, const ShapeWork& work, std::size_t count) {
    Budget budget;
    budget.guarantee = recipe.guarantee;
    budget.max_protrusion = work.max_protrusion;
    budget.cost = recipe.costs;
    if (count > 0 && recipe.budget_cost) {
        budget.max_cost = static_cast<double>(count) * price_step;
        budget.max_spheres = std::min(work.most_elements, std::max<std::size_t>(1, count / work.unit));
    } else if (count > 0) {
        budget.max_spheres = count;
    }
    return budget;
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
        const StageLog& log = entry.log;
        if (log.call.empty()) {
            continue; // no spherizer was called
        }
        if (work.calls.insert(log.call).second) {
            workspace.journal.repeat(log, work.link, work.spherizer.stage);
        }
        work.report.metrics = log.metrics;
    }
}

} // namespace

Digest tree_key(const Workspace& workspace, const ShapeWork& work, std::size_t count) {
    Hasher hasher;
    hasher.add("spherize").add(work.digest).add(work.content).add(workspace.recipe.seed);
    hasher.add(static_cast<std::uint64_t>(count));
    hasher.add(static_cast<std::uint64_t>(workspace.recipe.guarantee));
    hasher.add(work.max_protrusion.value_or(-1));
    if (workspace.recipe.budget_cost) {
        hasher.add("cost").add(workspace.recipe.costs.of_hull_vertex);
        hasher.add(static_cast<std::uint64_t>(work.most_elements));
        for (const double price : workspace.recipe.costs.of_kind) {
            hasher.add(price);
        }
    }
    return hasher.finish();
}

void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    std::vector<Budget> budgets;
    std::vector<Digest> keys;
    std::vector<std::size_t> missing;
    std::map<std::size_t, Cached<SphereTree>> known; // by requested count
    const auto ball = // no spherizer can do better
        knows_all(work.kinds, {Element::Kind::sphere}) ? balls_of(work.shape->original(), 1) : std::nullopt;
    for (const std::size_t count : counts) {
        if (work.known.asked.contains(count)) {
            continue;
        }
        if (ball) {
            known[count].result = flat_tree(*ball);
            continue;
        }
        const Budget budget = budget_of(workspace.recipe, work, count);
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
        StageLog log;
        std::vector<SphereTree> trees = run_spherizer(workspace, work, budgets, log);
        log.call = call_name(keys);
        work.calls.insert(log.call); // its findings are in the journal
        parallel_for(trees.size(), [&](std::size_t i) {
            const std::size_t most = budgets[i].max_spheres.value_or(trees[i].elements().size());
            trees[i] = refined(workspace, work, std::move(trees[i]), most, Refiners::not_adding);
        });
        const bool whole = !workspace.ended(); // else a stage may have returned early
        for (std::size_t i = 0; i < trees.size(); ++i) {
            if (whole) {
                workspace.cache.put(keys[i], trees[i], log);
            }
            known[missing[i]] = {std::move(trees[i]), log};
        }
    }
    add_words(workspace, work, known);
    // By count, whatever the cache had: of two trees of one size, the one with the smaller requested count stays.
    for (auto& [count, entry] : known) {
        const std::size_t got = size_of(workspace.recipe, entry.result.elements());
        work.known.asked[count] = got;
        work.known.trees.try_emplace(got, std::move(entry.result));
    }
}

} // namespace foam::inline runtime
