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

/// Returns the part of the solid's surface that the kept spheres leave uncovered; the whole one if that is nothing.
static std::shared_ptr<const Solid> uncovered_part(std::shared_ptr<const Solid> solid,
                                                   const std::vector<Sphere>& kept) {
    Mesh left = geometry::left_uncovered(solid->surface(), kept);
    return left.triangles.empty() ? std::move(solid) : Solid::make(std::move(left));
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
