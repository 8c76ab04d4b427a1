#include "input/shapes.hpp"

#include "allocate/exploration.hpp"
#include "input/inputs.hpp"

#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/internal/solids.hpp>

#include <foam/sdk/kinds.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {

bool wants_least_excess(const Recipe& recipe, const ShapeWork& work) {
    if (recipe.guarantee == Guarantee::fitted) {
        return false; // here the symmetric difference is least, and each count needs its own search
    }
    return recipe.guarantee != Guarantee::outer || work.objective == Objective::excess;
}

std::optional<std::size_t> total_of(const Recipe& recipe) {
    return recipe.budget_cost ? std::optional(static_cast<std::size_t>(*recipe.budget_cost / price_step + 1e-6))
                              : recipe.budget_spheres;
}

std::size_t size_of(const Recipe& recipe, const Elements& elements) {
    return recipe.budget_cost
               ? static_cast<std::size_t>(std::ceil(price_of(elements, recipe.costs) / price_step - 1e-6))
               : elements.size();
}

const char* plural_of(const std::vector<ShapeWork>& shapes) {
    const bool spheres =
        std::all_of(shapes.begin(), shapes.end(), [](const ShapeWork& work) { return spheres_alone(work.kinds); });
    return spheres ? "spheres" : "elements";
}

static Solid::Part part_of(const LinkWork& link, std::size_t e, const Pose& pose, bool processed) {
    const CollisionElement& element = link.elements[e];
    Solid::Part part;
    part.covers = link.covers;
    if (const Element* primitive = element.primitive()) {
        part.primitive = *primitive;
        part.pose = pose;
    } else {
        const std::shared_ptr<const Mesh> mesh = processed ? element.processed() : element.raw;
        part.mesh = pose == Pose{} ? mesh : std::make_shared<const Mesh>(transformed(*mesh, pose));
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

/// Returns the pose of an element in its group's frame; exactly the identity for the first element.
static Pose relative_pose(const Group& group, const LinkWork& link, std::size_t element) {
    return element == group.elements.front() ? Pose{} : group.frame.inverse() * link.elements[element].source->origin;
}

static bool original_only(const Workspace& workspace, const StageCall& spherizer) {
    const RegisteredStage* stage = workspace.registry.find(spherizer.stage);
    return stage && stage->info.original_only;
}

/// Returns the frame in which the spherizer gets the group's shape.
static geometry::OwnFrame frame_of(const Workspace& workspace, const Group& group, const LinkWork& link) {
    Box whole;
    bool dusty = false;
    for (const std::size_t e : group.elements) {
        const CollisionElement& element = link.elements[e];
        whole.add(posed(bounds_of(element), relative_pose(group, link, e)));
        dusty = dusty || (element.raw && geometry::may_have_dust(*element.raw)) ||
                (!element.filtered.empty() && geometry::may_have_dust(*element.processed()));
    }
    return frame_for_stage(geometry::own_frame(whole, dusty), link.recipe.spherizer, workspace.registry);
}

/// Returns the kept spheres in the frame in which the group's shape is spherized.
static std::vector<Sphere> kept_of(const Group& group, const LinkWork& link) {
    std::vector<Sphere> kept = link.recipe.keep;
    for (Sphere& sphere : kept) {
        sphere.center = group.frame.inverse() * sphere.center;
    }
    return kept;
}

/// Returns the digest of the geometry that the spherizer gets, not of how it was made: random draws stay the same when
/// a filter or a parameter changes nothing.
static Digest content_of(const Workspace& workspace, const Group& group, const LinkWork& link) {
    const bool raw_only = original_only(workspace, link.recipe.spherizer);
    Hasher hasher;
    for (const std::size_t e : group.elements) {
        const CollisionElement& element = link.elements[e];
        if (const Element* primitive = element.primitive()) {
            add_primitive(hasher, *primitive);
        } else {
            hasher.add(*element.raw);
        }
        if (!raw_only && !element.filtered.empty()) {
            hasher.add(*element.processed());
        }
        hasher.add(relative_pose(group, link, e));
    }
    for (const Sphere& sphere : kept_of(group, link)) {
        hasher.add("keep").add(sphere.center).add(sphere.radius);
    }
    return hasher.finish();
}

/// Returns the half-space constraints in the frame in which the group's shape is spherized.
static std::vector<ClipPlane> planes_of(const Group& group, const LinkWork& link) {
    std::vector<ClipPlane> planes;
    for (const ClipPlane& plane : link.recipe.clip) {
        planes.push_back(seen_from(plane, group.frame));
    }
    return planes;
}

/// Returns the part of the solid's surface that the kept spheres leave uncovered; the whole one if that is nothing.
static std::shared_ptr<const Solid> uncovered_part(std::shared_ptr<const Solid> solid,
                                                   const std::vector<Sphere>& kept) {
    Mesh left = geometry::left_uncovered(solid->surface(), kept);
    return left.triangles.empty() ? std::move(solid) : Solid::make(std::move(left));
}

/// Sets the kinds of elements of a shape, and with a budget of cost the unit of its counts.
static void set_kinds(const Workspace& workspace, const Recipe::LinkRecipe& recipe, ShapeWork& work) {
    work.kinds = workspace.registry.find(work.spherizer.stage)->info.kinds;
    if (!workspace.recipe.budget_cost) {
        return;
    }
    const double price = least_price(work.kinds, workspace.recipe.costs);
    work.unit = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(price / price_step - 1e-6)));
    work.least *= work.unit;
    work.most_elements = recipe.max_spheres ? work.most : SIZE_MAX;
    work.most = SIZE_MAX;
    work.adds_spheres = false; // refiners that add spheres count them, not their cost
}

/// Returns what there is to do for the shape of a group, but for its digest, half-space constraints and frame.
static ShapeWork work_for(const Workspace& workspace, const LinkWork& link, const Group& group) {
    ShapeWork work;
    work.spherizer = link.recipe.spherizer;
    work.refiners = link.recipe.refiners;
    work.adds_spheres = std::any_of(work.refiners.begin(), work.refiners.end(), [&](const StageCall& refiner) {
        return workspace.registry.find(refiner.stage)->info.adds_spheres;
    });
    work.objective = objective_of(work.spherizer, workspace.registry);
    work.content = content_of(workspace, group, link);
    work.link = link.link->name;
    work.input = link.elements[group.elements.front()].geometry;
    work.report.stage = work.spherizer.stage;
    const std::size_t kept = link.recipe.keep.size();
    work.least = std::max(kept + 1, link.recipe.min_spheres) - kept;
    work.most = link.recipe.max_spheres ? std::max(work.least, *link.recipe.max_spheres - kept) : SIZE_MAX;
    set_kinds(workspace, link.recipe, work);
    work.max_protrusion = link.recipe.max_protrusion;
    return work;
}

std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups) {
    std::map<Digest, std::size_t> known;
    std::vector<ShapeWork> shapes;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const LinkWork& link = links[groups[g].link];
        Hasher hasher;
        add_call(hasher, link.recipe.spherizer, workspace.registry);
        for (const StageCall& refiner : link.recipe.refiners) {
            add_call(hasher, refiner, workspace.registry);
        }
        const bool raw = original_only(workspace, link.recipe.spherizer);
        for (const std::size_t e : groups[g].elements) {
            const CollisionElement& element = link.elements[e];
            hasher.add(raw && element.raw ? digest_of_content(*element.raw) : element.digest);
            hasher.add(relative_pose(groups[g], link, e));
        }
        const std::vector<ClipPlane> planes = planes_of(groups[g], link);
        for (const ClipPlane& plane : planes) {
            hasher.add("clip").add(plane.normal).add(plane.offset).add(plane.reach);
        }
        if (link.recipe.hollow == Hollow::fill) {
            hasher.add("fill");
        }
        if (link.covers == Covers::surface) {
            hasher.add("surface");
        }
        for (const Sphere& sphere : kept_of(groups[g], link)) {
            hasher.add("keep").add(sphere.center).add(sphere.radius);
        }
        const geometry::OwnFrame frame = frame_of(workspace, groups[g], link);
        if (!frame.is_given()) {
            hasher.add("frame").add(frame.origin).add(frame.scale()).add(frame.dust);
        }
        const Digest digest =
            hasher.finish(); // the result of a spherizer does not depend on the bounds of the number of spheres
        hasher.add(static_cast<std::uint64_t>(link.recipe.min_spheres));
        hasher.add(static_cast<std::uint64_t>(link.recipe.max_spheres.value_or(0)));
        add_isolation(hasher, link.recipe.spherizer.isolation);
        hasher.add(link.recipe.max_protrusion.value_or(-1));
        const auto [it, fresh] = known.try_emplace(hasher.finish(), shapes.size());
        if (fresh) {
            ShapeWork& work = shapes.emplace_back(work_for(workspace, link, groups[g]));
            work.digest = digest;
            work.clip = planes;
            work.frame = frame;
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
    const bool filtered = !raw_only && std::any_of(group.elements.begin(), group.elements.end(),
                                                   [&](std::size_t e) { return !link.elements[e].filtered.empty(); });
    for (const std::size_t e : group.elements) {
        const Pose pose = relative_pose(group, link, e);
        original.push_back(part_of(link, e, pose, false));
        if (filtered) {
            processed.push_back(part_of(link, e, pose, true));
        }
    }
    work.original = work.unfilled = Solid::make(std::move(original));
    std::shared_ptr<const Solid> whole = filtered ? Solid::make(std::move(processed)) : work.original;
    if (link.recipe.hollow == Hollow::fill) {
        whole = geometry::filled(whole);
        work.original = filtered ? geometry::filled(work.original) : whole;
    }
    if (group.uncovered) {
        const std::vector<Sphere> kept = kept_of(group, link);
        whole = uncovered_part(std::move(whole), kept);
        work.original = filtered ? uncovered_part(work.original, kept) : whole;
    }
    work.built = digest_of_content(work.original->surface());
    work.cavities = workspace.recipe.guarantee == Guarantee::outer ? geometry::cavity_volume(*work.original) : 0;
    require_within(*work.original, group.frame, link.recipe.clip);
    work.shape = std::make_unique<Shape>(work.link, std::move(whole), work.original);
    if (!work.frame.is_given()) {
        work.own = std::make_unique<Shape>(work.frame.to_own(*work.shape));
    }
    begin_refinements(workspace, work);
}

} // namespace foam::inline runtime
