#include "allocate/exploration.hpp"
#include "input/inputs.hpp"
#include "input/shapes.hpp"

#include <foam/geometry/internal/proof.hpp>

#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {

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

Pose relative_pose(const Group& group, const LinkWork& link, std::size_t element) {
    return element == group.elements.front() ? Pose{} : group.frame.inverse() * link.elements[element].source->origin;
}

bool original_only(const Workspace& workspace, const StageCall& spherizer) {
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

std::vector<Sphere> kept_of(const Group& group, const LinkWork& link) {
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

/// What decides on the result for a group.
struct Deciding {
    Digest settings; ///< all but the geometry
    Digest result;   ///< settings and geometry, without what the spherizer is not told
    Digest all;
};

/// Adds the calls that make and refine a link's elements.
static void add_calls(Hasher& hasher, const Workspace& workspace, const LinkWork& link) {
    add_call(hasher, link.recipe.spherizer, workspace.registry);
    for (const StageCall& refiner : link.recipe.refiners) {
        add_call(hasher, refiner, workspace.registry);
    }
}

/// Returns the digest of what the recipe asks for a group: its calls and what bounds their result.
static Digest settings_of(const Workspace& workspace, const LinkWork& link) {
    Hasher hasher;
    for (const StageCall& filter : link.recipe.filters) {
        add_call(hasher, filter, workspace.registry);
    }
    add_calls(hasher, workspace, link);
    hasher.add(link.recipe.hollow == Hollow::fill ? "fill" : "keep");
    hasher.add(link.covers == Covers::surface ? "surface" : "solid");
    hasher.add(static_cast<std::uint64_t>(link.recipe.min_spheres));
    hasher.add(static_cast<std::uint64_t>(link.recipe.max_spheres.value_or(0)));
    add_isolation(hasher, link.recipe.spherizer.isolation);
    hasher.add(link.recipe.max_protrusion.value_or(-1));
    return hasher.finish();
}

static Deciding deciding_of(const Workspace& workspace, const LinkWork& link, const Group& group,
                            const geometry::OwnFrame& frame) {
    Hasher hasher;
    add_calls(hasher, workspace, link);
    const bool raw = original_only(workspace, link.recipe.spherizer);
    for (const std::size_t e : group.elements) {
        const CollisionElement& element = link.elements[e];
        hasher.add(raw && element.raw ? digest_of_content(*element.raw) : element.digest);
        hasher.add(relative_pose(group, link, e));
    }
    for (const ClipPlane& plane : planes_of(group, link)) {
        hasher.add("clip").add(plane.normal).add(plane.offset).add(plane.reach);
    }
    if (link.recipe.hollow == Hollow::fill) {
        hasher.add("fill");
    }
    if (link.covers == Covers::surface) {
        hasher.add("surface");
    }
    for (const Sphere& sphere : kept_of(group, link)) {
        hasher.add("keep").add(sphere.center).add(sphere.radius);
    }
    if (!frame.is_given()) {
        hasher.add("frame").add(frame.origin).add(frame.scale()).add(frame.dust);
    }
    Deciding result;
    result.result = hasher.finish(); // it does not depend on the bounds of the number of spheres
    result.settings = settings_of(workspace, link);
    hasher.add(result.settings);
    result.all = hasher.finish();
    return result;
}

static Form form_of(const LinkWork& link, const Group& group) {
    Form form;
    for (const std::size_t e : group.elements) {
        FormPart& part = form.emplace_back();
        part.pose = relative_pose(group, link, e);
        if (const Element* primitive = link.elements[e].primitive()) {
            part.primitive = moved(*primitive, part.pose);
            part.pose = {};
        } else {
            part.mesh = link.elements[e].raw.get();
        }
    }
    return form;
}

/// Returns whether a link's geometry may be searched as the image of another's: nothing in its own frame bounds it.
static bool may_be_image(const LinkWork& link) {
    return link.recipe.clip.empty() && link.recipe.keep.empty();
}

static void say_image(const Workspace& workspace, const LinkWork& link, const LinkWork& other, const Likeness& image) {
    if (&link != &other) {
        workspace.journal.finding(
            {Severity::info, link.link->name, "",
             fmt::format("its geometry is {} that of {}: one search serves both",
                         image.mirrored ? "the mirror image of" : "the same as", other.link->name)});
    }
}

std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups) {
    std::map<Digest, std::pair<std::size_t, Likeness>> known;
    std::vector<ShapeWork> shapes;
    std::multimap<Digest, std::size_t> by_settings; // shapes that others may be images of
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const LinkWork& link = links[groups[g].link];
        const geometry::OwnFrame frame = frame_of(workspace, groups[g], link);
        const Deciding deciding = deciding_of(workspace, link, groups[g], frame);
        auto found = known.find(deciding.all);
        if (found == known.end() && may_be_image(link)) {
            const auto [begin, end] = by_settings.equal_range(deciding.settings);
            for (auto it = begin; it != end && found == known.end(); ++it) {
                const Group& first = groups[shapes[it->second].groups.front()];
                if (const auto image = likeness(form_of(links[first.link], first), form_of(link, groups[g]))) {
                    found = known.emplace(deciding.all, std::pair(it->second, *image)).first;
                    say_image(workspace, link, links[first.link], *image);
                }
            }
        }
        if (found == known.end()) {
            found = known.emplace(deciding.all, std::pair(shapes.size(), Likeness{})).first;
            ShapeWork& work = shapes.emplace_back(work_for(workspace, link, groups[g]));
            work.digest = deciding.result;
            work.clip = planes_of(groups[g], link);
            work.frame = frame;
            if (may_be_image(link)) {
                by_settings.emplace(deciding.settings, found->second.first);
            }
        }
        groups[g].shape = found->second.first;
        groups[g].from_shape = found->second.second;
        shapes[groups[g].shape].groups.push_back(g);
    }
    return shapes;
}

} // namespace foam::inline runtime
