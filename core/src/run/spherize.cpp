#include "spherize.hpp"

#include "allocation.hpp"
#include "cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam {
namespace {

/// A distinct shape and what is known of it.
struct ShapeWork {
    std::unique_ptr<Shape> shape;
    StageCall spherizer;
    Digest digest;
    std::string link, input; ///< of the first group, for messages
    std::vector<std::size_t> groups;
    std::size_t least = 1, most = 1;          ///< bounds of the count
    std::map<std::size_t, SphereTree> trees;  ///< by the number of spheres they have
    std::map<std::size_t, std::size_t> asked; ///< count asked for → count got
    CostCurve curve;
    StageReport report;
    std::optional<Error> error;
};

/// Largest number of spheres that a link gets from a robot-wide protrusion budget.
constexpr std::size_t protrusion_limit = 256;

Solid::Part part_of(const Element& element, const Pose& pose, bool processed) {
    Solid::Part part;
    if (const Primitive* primitive = element.primitive()) {
        part.primitive = *primitive;
        part.pose = pose;
    } else {
        part.mesh = std::make_shared<const Mesh>(transformed(processed ? *element.processed() : *element.raw, pose));
    }
    return part;
}

std::vector<Group> make_groups(const Workspace& workspace, const std::vector<LinkWork>& links) {
    std::vector<Group> groups;
    for (std::size_t l = 0; l < links.size(); ++l) {
        if (links[l].recipe.skip || links[l].error) {
            continue;
        }
        for (std::size_t e = 0; e < links[l].elements.size(); ++e) {
            if (e == 0 || !workspace.recipe.per_link) {
                Group& group = groups.emplace_back();
                group.link = l;
                group.frame = links[l].elements[e].source->origin;
            }
            groups.back().elements.push_back(e);
        }
    }
    return groups;
}

/// Pose of an element in its group's frame; exactly the identity for the first.
Pose relative_pose(const Group& group, const LinkWork& link, std::size_t element) {
    return element == group.elements.front() ? Pose{} : group.frame.inverse() * link.elements[element].source->origin;
}

std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups) {
    std::map<Digest, std::size_t> known;
    std::vector<ShapeWork> shapes;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const LinkWork& link = links[groups[g].link];
        Hasher hasher;
        hasher.add(link.recipe.spherizer, workspace.registry).add(static_cast<std::uint64_t>(link.recipe.min_spheres));
        hasher.add(static_cast<std::uint64_t>(link.recipe.max_spheres.value_or(0)));
        for (const std::size_t e : groups[g].elements) {
            hasher.add(link.elements[e].digest).add(relative_pose(groups[g], link, e));
        }
        const Digest digest = hasher.finish();
        const auto [it, fresh] = known.try_emplace(digest, shapes.size());
        if (fresh) {
            ShapeWork& work = shapes.emplace_back();
            work.spherizer = link.recipe.spherizer;
            work.digest = digest;
            work.link = link.link->name;
            work.input = link.elements[groups[g].elements.front()].geometry;
            work.report.stage = work.spherizer.stage;
            work.least = std::max<std::size_t>(1, link.recipe.min_spheres);
            work.most = std::max(work.least, link.recipe.max_spheres.value_or(SIZE_MAX));
        }
        groups[g].shape = it->second;
        shapes[it->second].groups.push_back(g);
    }
    return shapes;
}

void build_shape(const std::vector<LinkWork>& links, const std::vector<Group>& groups, ShapeWork& work) {
    const Group& group = groups[work.groups.front()];
    const LinkWork& link = links[group.link];
    std::vector<Solid::Part> original, processed;
    bool filtered = false;
    for (const std::size_t e : group.elements) {
        const Pose pose = relative_pose(group, link, e);
        original.push_back(part_of(link.elements[e], pose, false));
        processed.push_back(part_of(link.elements[e], pose, true));
        filtered |= !link.elements[e].filtered.empty();
    }
    const auto raw = Solid::make(std::move(original));
    work.shape = std::make_unique<Shape>(work.link, filtered ? Solid::make(std::move(processed)) : raw, raw);
}

/// A spherizer's promise, checked: spheres, finite, no more than asked for.
void check_tree(const SphereTree& tree, const Budget& budget) {
    const auto broken = [](const std::string& what) {
        throw Error(ErrorCode::plugin, "the spherizer broke its contract: " + what);
    };
    if (tree.levels.empty() || tree.finest().empty()) {
        broken("it returned no spheres");
    }
    if (budget.max_spheres && tree.finest().size() > *budget.max_spheres) {
        broken(fmt::format("it returned {} spheres where at most {} were asked for", tree.finest().size(),
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

/// Trees for the counts that are asked for, from the cache or the stage. Count 0 stands for "no budget".
void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    std::vector<Budget> budgets;
    std::vector<Digest> keys;
    std::vector<std::size_t> missing;
    const auto keep = [&](std::size_t count, SphereTree tree) {
        const std::size_t got = tree.finest().size();
        work.asked[count] = got;
        work.trees.try_emplace(got, std::move(tree));
    };
    for (const std::size_t count : counts) {
        if (work.asked.contains(count)) {
            continue;
        }
        Budget budget;
        budget.guarantee = workspace.recipe.guarantee;
        budget.max_protrusion = workspace.recipe.budget_max_protrusion;
        if (count > 0) {
            budget.max_spheres = count;
        }
        Hasher hasher;
        hasher.add("spherize").add(work.digest).add(workspace.recipe.seed).add(static_cast<std::uint64_t>(count));
        hasher.add(static_cast<std::uint64_t>(budget.guarantee)).add(budget.max_protrusion.value_or(-1));
        const Digest key = hasher.finish();
        if (auto cached = workspace.cache.tree(key)) {
            keep(count, std::move(*cached));
            continue;
        }
        budgets.push_back(budget);
        keys.push_back(key);
        missing.push_back(count);
    }
    work.report.cached = missing.empty() && (work.report.cached || work.report.seconds == 0);
    if (missing.empty()) {
        return;
    }
    const std::vector<SphereTree> trees = run_stage(
        workspace, work.spherizer.stage, work.link, work.input, work.digest, work.report, [&](Context& context) {
            const auto stage = workspace.registry.make<Spherizer>(work.spherizer.stage, work.spherizer.given);
            std::vector<SphereTree> made = stage->spherize_each(*work.shape, budgets, context);
            if (made.size() != budgets.size()) {
                throw Error(ErrorCode::plugin, fmt::format("the spherizer broke its contract: {} trees for {} budgets",
                                                           made.size(), budgets.size()));
            }
            for (std::size_t i = 0; i < made.size(); ++i) {
                check_tree(made[i], budgets[i]);
            }
            return made;
        });
    for (std::size_t i = 0; i < trees.size(); ++i) {
        workspace.cache.put(keys[i], trees[i]);
        keep(missing[i], trees[i]);
    }
}

/// Runs `body` for the shapes that have no error yet, on all cores; errors stay with the shape.
template <class Body> void for_each_shape(std::vector<ShapeWork>& shapes, Body&& body) {
    parallel_for(shapes.size(), [&](std::size_t s) {
        if (shapes[s].error) {
            return;
        }
        try {
            body(s);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            shapes[s].error.emplace(error);
        }
    });
}

/// Makes the curves know the counts asked for: spherize, cover, measure what is claimed wrongly.
void explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
             const std::vector<std::vector<std::size_t>>& counts) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        workspace.journal.expect(counts[s].empty() ? 0 : 1);
    }
    for_each_shape(shapes, [&](std::size_t s) { compute_trees(workspace, shapes[s], counts[s]); });
    struct Point {
        std::size_t shape, count;
        double cost;
    };
    std::vector<Point> points;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (const auto& [count, tree] : shapes[s].trees) {
            if (!shapes[s].error && !shapes[s].curve.knows(count)) {
                points.push_back({s, count, 0});
            }
        }
    }
    parallel_for(points.size(), [&](std::size_t i) {
        workspace.check_cancelled();
        const ShapeWork& work = shapes[points[i].shape];
        points[i].cost =
            wrong_volume(work.shape->original(), work.trees.at(points[i].count).finest(), workspace.recipe.guarantee);
    });
    for (const Point& point : points) {
        shapes[point.shape].curve.set(point.count, point.cost);
    }
}

std::vector<Claim> claims_of(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, std::size_t total,
                             bool known_only) {
    std::vector<Claim> claims;
    for (const Group& group : groups) {
        const ShapeWork& work = shapes[group.shape];
        if (!work.error) {
            claims.push_back({&work.curve, work.least, std::min(work.most, total), known_only});
        }
    }
    return claims;
}

/// The count of every group (0 for those with an error) so that the robot has `total` spheres at the least wrong
/// volume. The curves are explored where the allocation goes, until it only rests on known counts.
std::vector<std::size_t> share_spheres(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                       const std::vector<Group>& groups, std::size_t total) {
    std::vector<std::vector<std::size_t>> wanted(shapes.size());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        // A first look at small counts and, on large budgets, at multiples of the fair share.
        const std::size_t fair = std::max<std::size_t>(1, total / std::max<std::size_t>(1, groups.size()));
        for (const std::size_t count :
             {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}, fair, 2 * fair, 4 * fair}) {
            wanted[s].push_back(std::clamp(count, shapes[s].least, std::min(shapes[s].most, total)));
        }
        std::sort(wanted[s].begin(), wanted[s].end());
        wanted[s].erase(std::unique(wanted[s].begin(), wanted[s].end()), wanted[s].end());
    }
    std::vector<std::size_t> counts;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        explore(workspace, shapes, wanted);
        const std::vector<Claim> claims = claims_of(shapes, groups, total, false);
        counts = allocate(claims, total);
        if (counts.empty()) {
            break;
        }
        bool settled = true;
        for (auto& list : wanted) {
            list.clear();
        }
        std::size_t c = 0;
        for (const Group& group : groups) {
            ShapeWork& work = shapes[group.shape];
            if (work.error) {
                continue;
            }
            const std::size_t count = counts[c++];
            // The neighbours too: the next round then knows whether one more or less pays.
            for (std::size_t near = std::max(work.least, count - 1); near <= std::min({work.most, total, count + 1});
                 ++near) {
                if (!work.asked.contains(near)) {
                    wanted[group.shape].push_back(near);
                    settled &= near != count;
                }
            }
        }
        if (settled && round > 0) {
            break;
        }
    }
    // Only counts that spherizers delivered. If they do not add up to the total, the largest sum below it.
    for (std::size_t sum = total; sum >= 1; --sum) {
        const std::vector<std::size_t> exact = allocate(claims_of(shapes, groups, total, true), sum);
        if (exact.empty()) {
            continue;
        }
        if (sum < total) {
            workspace.journal.finding({Severity::warning, "", "",
                                       fmt::format("{} of {} spheres are used: the spherizer has no use "
                                                   "for more on these links",
                                                   sum, total)});
        }
        std::vector<std::size_t> result(groups.size(), 0);
        std::size_t c = 0;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (!shapes[groups[g].shape].error) {
                result[g] = exact[c++];
            }
        }
        return result;
    }
    return std::vector<std::size_t>(groups.size(), 0);
}

/// The fewest spheres whose cover protrudes by no more than the limit: doubled until it holds, then bisected.
std::size_t count_for_protrusion(const Workspace& workspace, ShapeWork& work, double limit) {
    const auto protrusion = [&](std::size_t count) {
        workspace.journal.expect(1);
        compute_trees(workspace, work, {count});
        return covered_protrusion(work.shape->original(), work.trees.at(work.asked.at(count)).finest(),
                                  workspace.recipe.guarantee);
    };
    const std::size_t most = std::min(work.most, std::max(work.least, protrusion_limit));
    std::size_t low = work.least, high = work.least;
    while (protrusion(high) > limit) {
        if (high == most) {
            workspace.journal.finding({Severity::warning, work.link, work.spherizer.stage,
                                       fmt::format("{} spheres still protrude by more than {} m", most, limit)});
            return work.asked.at(most);
        }
        low = high + 1;
        high = std::min(2 * high, most);
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (protrusion(middle) > limit) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    protrusion(high);
    return work.asked.at(high);
}

std::vector<std::size_t> choose_counts(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                       const std::vector<Group>& groups) {
    const Recipe& recipe = workspace.recipe;
    if (recipe.budget_spheres) {
        std::size_t least = 0;
        for (const Group& group : groups) {
            least += shapes[group.shape].least;
        }
        if (*recipe.budget_spheres < least) {
            throw Error(
                ErrorCode::recipe,
                fmt::format(
                    "budget.spheres: {} is not enough: the robot's {} {} with collision geometry need at least {}; "
                    "remedy: raise the budget, or skip links",
                    *recipe.budget_spheres, groups.size(), recipe.per_link ? "links" : "elements", least));
        }
        return share_spheres(workspace, shapes, groups, *recipe.budget_spheres);
    }
    std::vector<std::size_t> of_shape(shapes.size(), 0);
    for_each_shape(shapes, [&](std::size_t s) {
        ShapeWork& work = shapes[s];
        if (recipe.budget_max_protrusion) {
            of_shape[s] = count_for_protrusion(workspace, work, *recipe.budget_max_protrusion);
            return;
        }
        workspace.journal.expect(1);
        const std::size_t asked = work.most == SIZE_MAX ? 0 : work.most;
        compute_trees(workspace, work, {asked});
        of_shape[s] = work.asked.at(asked);
    });
    std::vector<std::size_t> counts(groups.size(), 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        counts[g] = of_shape[groups[g].shape];
    }
    return counts;
}

SphereTree moved(SphereTree tree, const Pose& pose) {
    for (SphereTree::Level& level : tree.levels) {
        for (Sphere& sphere : level.spheres) {
            sphere.center = pose * sphere.center;
        }
    }
    return tree;
}

} // namespace

std::vector<Group> spherize_links(const Workspace& workspace, std::vector<LinkWork>& links) {
    std::vector<Group> groups = make_groups(workspace, links);
    std::vector<ShapeWork> shapes = distinct_shapes(workspace, links, groups);
    for_each_shape(shapes, [&](std::size_t s) {
        try {
            build_shape(links, groups, shapes[s]);
        } catch (...) {
            throw described(std::current_exception(), "geometry", shapes[s].link, shapes[s].input);
        }
    });
    const std::vector<std::size_t> counts = choose_counts(workspace, shapes, groups);
    std::vector<Group> done;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const ShapeWork& work = shapes[groups[g].shape];
        LinkWork& link = links[groups[g].link];
        link.report.stages.push_back(work.report);
        if (work.error) {
            if (!link.error) {
                link.error.emplace(*work.error);
            }
            continue;
        }
        groups[g].tree = moved(work.trees.at(counts[g]), groups[g].frame);
        done.push_back(std::move(groups[g]));
    }
    std::erase_if(done, [&](const Group& group) { return links[group.link].error.has_value(); });
    return done;
}

} // namespace foam
