#include "shapes.hpp"

#include "clip.hpp"
#include "cover.hpp"
#include "fitted/fit.hpp"
#include "geometry/row_cover.hpp"
#include "isolated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam {

bool wants_least_excess(const Recipe& recipe, const ShapeWork& work) {
    if (recipe.guarantee == Guarantee::fitted) {
        return false; // the least of excess and missing together, and each number is a search of its own
    }
    return recipe.guarantee != Guarantee::outer || work.objective == Objective::excess;
}

static Solid::Part part_of(const Element& element, const Pose& pose, bool processed) {
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
                group.weight = links[l].recipe.weight;
            }
            groups.back().elements.push_back(e);
        }
    }
    return groups;
}

/// Pose of an element in its group's frame; exactly the identity for the first.
static Pose relative_pose(const Group& group, const LinkWork& link, std::size_t element) {
    return element == group.elements.front() ? Pose{} : group.frame.inverse() * link.elements[element].source->origin;
}

static bool original_only(const Workspace& workspace, const StageCall& spherizer) {
    const RegisteredStage* stage = workspace.registry.find(spherizer.stage);
    return stage && stage->info.original_only;
}

/// Not how the processed mesh came about: what is drawn at random stays when a filter or a parameter changes nothing.
static Digest content_of(const Workspace& workspace, const Group& group, const LinkWork& link) {
    const bool raw_only = original_only(workspace, link.recipe.spherizer);
    Hasher hasher;
    for (const std::size_t e : group.elements) {
        const Element& element = link.elements[e];
        if (const Primitive* primitive = element.primitive()) {
            hasher.add(*primitive);
        } else {
            hasher.add(*element.raw);
        }
        if (!raw_only && !element.filtered.empty()) {
            hasher.add(*element.processed());
        }
        hasher.add(relative_pose(group, link, e));
    }
    return hasher.finish();
}

/// In the frame in which the group's shape is spherized.
static std::vector<ClipPlane> planes_of(const Group& group, const LinkWork& link) {
    std::vector<ClipPlane> planes;
    for (const ClipPlane& plane : link.recipe.clip) {
        planes.push_back(seen_from(plane, group.frame));
    }
    return planes;
}

std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups) {
    std::map<Digest, std::size_t> known;
    std::vector<ShapeWork> shapes;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const LinkWork& link = links[groups[g].link];
        Hasher hasher;
        hasher.add(link.recipe.spherizer, workspace.registry);
        const bool raw = original_only(workspace, link.recipe.spherizer);
        for (const std::size_t e : groups[g].elements) {
            const Element& element = link.elements[e];
            hasher.add(raw && element.raw ? digest_of_content(*element.raw) : element.digest);
            hasher.add(relative_pose(groups[g], link, e));
        }
        const std::vector<ClipPlane> planes = planes_of(groups[g], link);
        for (const ClipPlane& plane : planes) {
            hasher.add("clip").add(plane.normal).add(plane.offset).add(plane.reach);
        }
        const Digest digest =
            hasher.finish(); // what a spherizer makes of it does not depend on the bounds of the count
        hasher.add(static_cast<std::uint64_t>(link.recipe.min_spheres));
        hasher.add(static_cast<std::uint64_t>(link.recipe.max_spheres.value_or(0)));
        add_isolation(hasher, link.recipe.spherizer.isolation);
        hasher.add(link.recipe.max_protrusion.value_or(-1));
        const auto [it, fresh] = known.try_emplace(hasher.finish(), shapes.size());
        if (fresh) {
            ShapeWork& work = shapes.emplace_back();
            work.spherizer = link.recipe.spherizer;
            work.objective = objective_of(work.spherizer, workspace.registry);
            work.digest = digest;
            work.content = content_of(workspace, groups[g], link);
            work.link = link.link->name;
            work.input = link.elements[groups[g].elements.front()].geometry;
            work.report.stage = work.spherizer.stage;
            work.least = std::max<std::size_t>(1, link.recipe.min_spheres);
            work.most = std::max(work.least, link.recipe.max_spheres.value_or(SIZE_MAX));
            work.max_protrusion = link.recipe.max_protrusion;
            work.clip = planes;
        }
        groups[g].shape = it->second;
        shapes[it->second].groups.push_back(g);
    }
    return shapes;
}

void build_shape(const Workspace& workspace, const std::vector<LinkWork>& links, const std::vector<Group>& groups,
                 ShapeWork& work) {
    const Group& group = groups[work.groups.front()];
    const LinkWork& link = links[group.link];
    const bool raw_only = original_only(workspace, work.spherizer);
    std::vector<Solid::Part> original, processed;
    bool filtered = false;
    for (const std::size_t e : group.elements) {
        const Pose pose = relative_pose(group, link, e);
        original.push_back(part_of(link.elements[e], pose, false));
        processed.push_back(part_of(link.elements[e], pose, !raw_only));
        filtered |= !raw_only && !link.elements[e].filtered.empty();
    }
    work.original = Solid::make(std::move(original));
    require_within(*work.original, group.frame, link.recipe.clip);
    work.shape =
        std::make_unique<Shape>(work.link, filtered ? Solid::make(std::move(processed)) : work.original, work.original);
}

/// A spherizer's promise, checked: spheres, finite, no more than asked for.
static void check_tree(const SphereTree& tree, const Budget& budget) {
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

/// The sphere that a shape is, if it is one: no spherizer could do better.
static std::optional<Sphere> as_sphere(const Solid& solid) {
    const Solid::Part& part = solid.parts().front();
    if (solid.parts().size() > 1 || !part.primitive || part.primitive->kind != Primitive::Kind::sphere) {
        return {};
    }
    return Sphere{part.pose.translation, part.primitive->radius};
}

/// A cylinder or capsule with a number of spheres: a row of equal ones along the axis, in closed form, stands in for
/// what the spherizer found where it claims less.
static void take_better_row(const Workspace& workspace, const ShapeWork& work, std::size_t count, SphereTree& tree) {
    const Recipe& recipe = workspace.recipe;
    if (count == 0 || recipe.guarantee != Guarantee::outer || work.max_protrusion || !work.clip.empty() ||
        tree.levels.size() > 2 || !wants_least_excess(recipe, work)) {
        return;
    }
    const Solid& solid = work.shape->original();
    if (auto row = geometry::row_cover(solid, count);
        row && wrong_volume(solid, *row, recipe.guarantee) < wrong_volume(solid, tree.finest(), recipe.guarantee)) {
        tree = flat_tree(std::move(*row));
    }
}

/// With guarantee fitted the finest level is fitted, whatever stage it is from: stages give spheres that cover. Coarser
/// levels stay bounds of it; in deep trees spheres stay near their parents.
static void fit_finest(const Solid& solid, const Budget& budget, SphereTree& tree) {
    SphereTree::Level& finest = tree.levels.back();
    const bool flat = tree.levels.size() <= 2;
    finest.spheres = fitted::fit(solid, finest.spheres, budget.max_spheres.value_or(finest.spheres.size()),
                                 flat ? fitted::Reach::far : fitted::Reach::near);
    if (tree.levels.size() > 1 && flat) {
        finest.parents.assign(finest.spheres.size(), 0);
    }
}

/// The finest level made to keep off the planes where it does not, whatever stage it is from: stages do not know of
/// them. Coarser levels but the root go.
static void keep_off_planes(const Workspace& workspace, const ShapeWork& work, const Budget& budget, SphereTree& tree) {
    const Solid& solid = work.shape->original();
    const bool outer = budget.guarantee == Guarantee::outer;
    if (keep_off(solid, outer ? grown_to_cover(solid, tree.finest()) : tree.finest(), work.clip)) {
        return;
    }
    if (outer) {
        const std::size_t count = budget.max_spheres.value_or(tree.finest().size());
        tree = flat_tree(covering_within(solid, tree.finest(), count, work.clip, workspace.recipe.seed));
    } else if (std::vector<Sphere> left = shaved(solid, tree.finest(), work.clip); !left.empty()) {
        tree = flat_tree(std::move(left));
    }
}

/// One tree for each budget, checked.
static std::vector<SphereTree> run_spherizer(const Workspace& workspace, ShapeWork& work,
                                             const std::vector<Budget>& budgets, StageLog& said) {
    return run_stage(
        workspace, work.spherizer.stage, work.link, work.input, work.content, work.report, [&](StageContext& context) {
            std::vector<SphereTree> made =
                call_spherizer(workspace, work.spherizer, work.stage, *work.shape, budgets, context);
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
                             [&](std::size_t i) { keep_off_planes(workspace, work, budgets[i], made[i]); });
            }
            said = context.said();
            return made;
        });
}

/// A call by the trees that it was to make.
static std::string call_name(const std::vector<Digest>& keys) {
    Hasher hasher;
    for (const Digest& key : keys) {
        hasher.add(key);
    }
    return hasher.finish();
}

/// Adds what the spherizer said to the run, once a call: by rising count, whatever the cache held, so that the metrics
/// of the same call stay.
static void add_words(const Workspace& workspace, ShapeWork& work,
                      const std::map<std::size_t, Cached<SphereTree>>& known) {
    for (const auto& [count, entry] : known) {
        const StageLog& said = entry.said;
        if (said.call.empty()) {
            continue; // no spherizer was asked
        }
        if (work.calls.insert(said.call).second) {
            workspace.journal.repeat(said, work.link, work.spherizer.stage);
        }
        work.report.metrics = said.metrics;
    }
}

void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    std::vector<Budget> budgets;
    std::vector<Digest> keys;
    std::vector<std::size_t> missing;
    std::map<std::size_t, Cached<SphereTree>> known; // by the count asked for
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
        const bool whole = !workspace.ended(); // else the stage may have given what it had when it was asked to stop
        for (std::size_t i = 0; i < trees.size(); ++i) {
            if (whole) {
                workspace.cache.put(keys[i], trees[i], said);
            }
            known[missing[i]] = {std::move(trees[i]), said};
        }
    }
    add_words(workspace, work, known);
    // By count, whatever the cache held: of two trees of one size the one that was asked for less stays.
    for (auto& [count, entry] : known) {
        take_better_row(workspace, work, count, entry.result);
        const std::size_t got = entry.result.finest().size();
        work.known.asked[count] = got;
        work.known.trees.try_emplace(got, std::move(entry.result));
    }
}

} // namespace foam
