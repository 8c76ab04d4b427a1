#include <foam/runtime/internal/cover.hpp>

#include "finish/finish.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/single_precision.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

namespace foam::inline runtime {
namespace {

/// Returns for each sphere the largest concentric sphere in the solid. Fast, for comparisons only.
std::vector<Sphere> inside_of(const Solid& solid, std::vector<Sphere> spheres) {
    for (Sphere& sphere : spheres) {
        sphere.radius = std::clamp(-solid.signed_distance(sphere.center), 0.0, sphere.radius);
    }
    std::erase_if(spheres, [](const Sphere& sphere) { return sphere.radius == 0; });
    return spheres;
}

Error no_room() {
    return Error(ErrorCode::geometry, "no sphere of this link lies inside its geometry; remedy: more spheres, another "
                                      "spherizer, or guarantee: outer or fitted; a surface without inside has no room");
}

/// Returns the spheres of a level that fit into the solid, with numbers on the grid. `left[i]`: the new index of sphere
/// i.
SphereTree::Level fitted_level(const Solid& solid, const SphereTree::Level& level, const DecimalGrid& grid,
                               Numbers numbers, std::vector<std::optional<std::uint32_t>>& left) {
    std::vector<Sphere> spheres = shrunk_to_fit(solid, level.elements.spheres());
    for (Sphere& sphere : spheres) {
        sphere.center = grid.nearest(sphere.center);
    }
    const std::vector<double> radii = inner_radii(solid, spheres);
    SphereTree::Level result;
    left.assign(spheres.size(), {});
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (const double radius = grid.down(radii[i] - float32_slack(spheres[i], numbers)); radius > 0) {
            left[i] = static_cast<std::uint32_t>(result.elements.spheres().size());
            result.elements.spheres().push_back({spheres[i].center, radius});
            if (!level.parents.empty()) {
                result.parents.push_back(level.parents[i]);
            }
        }
    }
    return result;
}

/// Moves every level into the solid, from the finest. An empty level becomes the largest sphere of the level below it.
/// Spheres whose parent is gone get the nearest sphere of that level as parent.
SphereTree inner_tree(const Solid& solid, const SphereTree& tree, const DecimalGrid& grid, Numbers numbers) {
    SphereTree result;
    result.levels.resize(tree.levels.size());
    for (std::size_t l = tree.levels.size(); l-- > 0;) {
        std::vector<std::optional<std::uint32_t>> left;
        SphereTree::Level& level = result.levels[l];
        level = fitted_level(solid, tree.levels[l], grid, numbers, left);
        if (l + 1 == tree.levels.size()) {
            if (level.elements.spheres().empty()) {
                throw no_room();
            }
            continue;
        }
        SphereTree::Level& below = result.levels[l + 1];
        if (level.elements.spheres().empty()) {
            level.elements.spheres() = {
                *std::max_element(below.elements.spheres().begin(), below.elements.spheres().end(),
                                  [](const Sphere& a, const Sphere& b) { return a.radius < b.radius; })};
            if (l > 0) {
                level.parents = {tree.levels[l].parents.at(0)};
            }
        }
        for (std::size_t i = 0; i < below.elements.spheres().size(); ++i) {
            const std::optional<std::uint32_t> parent = left[below.parents[i]];
            const auto nearer = [&](const Sphere& a, const Sphere& b) {
                return distance(a.center, below.elements.spheres()[i].center) <
                       distance(b.center, below.elements.spheres()[i].center);
            };
            below.parents[i] =
                parent ? *parent
                       : static_cast<std::uint32_t>(std::min_element(level.elements.spheres().begin(),
                                                                     level.elements.spheres().end(), nearer) -
                                                    level.elements.spheres().begin());
        }
    }
    return result;
}

double volume_of(const Sphere& sphere) {
    return 4 * std::numbers::pi / 3 * sphere.radius * sphere.radius * sphere.radius;
}

/// Returns one sphere around the solid if it has less excess volume than these spheres.
std::optional<Sphere> better_one(const Solid& solid, const std::vector<Sphere>& spheres) {
    const Sphere one = minimum_enclosing_sphere(solid.surface().vertices);
    double sum = 0;
    for (const Sphere& sphere : spheres) {
        sum += volume_of(sphere);
    }
    // The exact volume is expensive, and seldom needed for this decision.
    constexpr double clearly = 1 + 1e-4;
    if (sum <= clearly * volume_of(one) || geometry::joint_volume(solid, spheres) <= clearly * volume_of(one)) {
        return {};
    }
    return one;
}

/// Moves the spheres of a level onto the grid, grows them to cover, and rounds their radii up.
void finish_spheres(const Solid& solid, SphereTree::Level& level, const DecimalGrid& grid, bool outer,
                    Numbers numbers) {
    for (Sphere& sphere : level.elements.spheres()) {
        sphere.center = grid.nearest(sphere.center);
    }
    if (outer) {
        level.elements.spheres() = grown_to_cover(solid, std::move(level.elements.spheres()));
    }
    for (Sphere& sphere : level.elements.spheres()) {
        sphere.radius = grid.up(sphere.radius + (outer ? float32_slack(sphere, numbers) : 0));
    }
}

/// Returns the largest growth of a sphere's radius from one level to the same level.
double growth_of(const std::vector<Sphere>& before, const std::vector<Sphere>& after) {
    double growth = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        growth = std::max(growth, after[i].radius - before[i].radius);
    }
    return growth;
}

} // namespace

double cost_volume(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee) {
    if (guarantee == Guarantee::outer) {
        spheres = grown_to_cover(solid, std::move(spheres));
        const auto one = better_one(solid, spheres);
        return std::max(0.0, (one ? volume_of(*one) : geometry::joint_volume(solid, spheres)) - solid.volume());
    }
    if (guarantee == Guarantee::inner) {
        return std::max(0.0, solid.volume() - exact_union_volume(inside_of(solid, std::move(spheres))));
    }
    // vol(U \ S) is vol(U ∪ S) - vol(S), and vol(S \ U) is vol(U ∪ S) - vol(U).
    return std::max(0.0, 2 * geometry::joint_volume(solid, spheres) - solid.volume() - exact_union_volume(spheres));
}

double cost_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee) {
    if (elements.are_spheres()) {
        return cost_volume(solid, elements.spheres(), guarantee);
    }
    if (guarantee == Guarantee::outer) {
        return excess_volume(solid, grown_to_cover(solid, elements));
    }
    const auto [excess, missing] = excess_and_missing_volume(solid, elements);
    return excess + missing;
}

/// Returns the options for a quick measure of the largest protrusion.
static MeasureOptions quick_protrusion() {
    MeasureOptions options;
    options.surface_points = 1'000;
    options.volume_rays = 300;
    options.volume_points = 1'000;
    return options;
}

double covered_protrusion(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee) {
    if (guarantee == Guarantee::outer) {
        spheres = grown_to_cover(solid, std::move(spheres));
    }
    return measure(solid, spheres, quick_protrusion()).protrusion_max;
}

double protrusion_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee) {
    if (elements.are_spheres()) {
        return covered_protrusion(solid, elements.spheres(), guarantee);
    }
    const Elements grown = guarantee == Guarantee::outer ? grown_to_cover(solid, elements) : elements;
    return measure(solid, grown, quick_protrusion()).protrusion_max;
}

void require_room(const Solid& solid, const SphereTree& tree) {
    const std::vector<Sphere> inside = shrunk_to_fit(solid, tree.finest());
    if (std::none_of(inside.begin(), inside.end(), [](const Sphere& sphere) { return sphere.radius > 0; })) {
        throw no_room();
    }
}

/// Returns the grid for the numbers of a link's elements. It is fine enough for thin ones, to which a millionth of the
/// link's size would add too much.
static DecimalGrid grid_for(const Solid& solid, const SphereTree& tree) {
    constexpr double thin = 3e-2, flat = 1e-5, finer = 0.3;
    const double size = solid.bounds().diagonal();
    double least = size;
    for (const SphereTree::Level& level : tree.levels) {
        for (const Element& element : level.elements.shaped()) {
            least = std::min(least, thickness(element));
        }
    }
    return DecimalGrid(least < thin * size && least > flat * size ? finer * least : size);
}

FinishedTree finished_tree(const Solid& solid, SphereTree tree, Guarantee guarantee, bool one_may_do, Numbers numbers) {
    const DecimalGrid grid = grid_for(solid, tree);
    FinishedTree result;
    if (guarantee == Guarantee::inner) {
        result.tree = inner_tree(solid, tree, grid, numbers);
        return result;
    }
    const bool outer = guarantee == Guarantee::outer;
    result.tree = std::move(tree);
    for (SphereTree::Level& level : result.tree.levels) {
        if (!level.elements.are_spheres()) {
            result.growth = finish_elements(solid, level.elements, grid, outer, numbers);
            continue;
        }
        const std::vector<Sphere> before = level.elements.spheres();
        finish_spheres(solid, level, grid, outer, numbers);
        result.growth = growth_of(before, level.elements.spheres());
    }
    const bool spheres_alone = result.tree.levels.back().elements.are_spheres();
    const auto one = outer && one_may_do && spheres_alone ? better_one(solid, result.tree.finest()) : std::nullopt;
    if (one) {
        result = finished_tree(solid, flat_tree({*one}), guarantee, false, numbers);
        result.one_instead = true;
    }
    return result;
}

SphereTree padded(const Solid& solid, SphereTree tree, double length) {
    const DecimalGrid grid = grid_for(solid, tree);
    for (SphereTree::Level& level : tree.levels) {
        for (Sphere& sphere : level.elements.spheres()) {
            sphere.radius = grid.up(sphere.radius + length);
        }
        for (Element& element : level.elements.shaped()) {
            element = up_on_grid(grown(element, length), grid);
        }
    }
    return tree;
}

SphereTree beside_kept(const Solid& solid, SphereTree others) {
    // Corners of pieces of triangles are rounded: the others overlap these pieces by more than that.
    return padded(solid, std::move(others), 1e-9 * solid.bounds().diagonal());
}

namespace {

/// Returns the rotation with numbers in single precision, orthonormal to double precision again.
std::array<Vec3, 3> rounded(const std::array<Vec3, 3>& rotation) {
    const Vec3 x = normalized(geometry::in_single_precision(rotation[0]));
    const Vec3 y = geometry::in_single_precision(rotation[1]);
    const Vec3 across = normalized(y - x * dot(x, y));
    return {x, across, cross(x, across)};
}

} // namespace

Approximation moved(Approximation approximation, const Pose& pose) {
    for (Approximation::Level& level : approximation.levels) {
        level.elements = geometry::moved(std::move(level.elements), pose);
    }
    return approximation;
}

void add_elements(Panel& panel, const Elements& elements, const Pose& pose) {
    for (const Sphere& sphere : elements.spheres()) {
        panel.spheres.push_back({pose * sphere.center, sphere.radius});
    }
    for (const Element& element : elements.shaped()) {
        panel.meshes.push_back({std::make_shared<const Mesh>(enclosing_mesh(element)), pose, true});
    }
}

Elements in_single_precision(Elements elements) {
    for (Sphere& s : elements.spheres()) {
        s = {geometry::in_single_precision(s.center), geometry::in_single_precision(s.radius)};
    }
    for (Element& e : elements.shaped()) {
        e.pose.translation = geometry::in_single_precision(e.pose.translation);
        e.pose.rotation = e.pose.rotation == Pose{}.rotation ? e.pose.rotation : rounded(e.pose.rotation);
        e.half = geometry::in_single_precision(e.half);
        e.radius = geometry::in_single_precision(e.radius);
        if (e.hull) {
            std::vector<Vec3> vertices;
            for (const Vec3& vertex : e.hull->surface.vertices) {
                vertices.push_back(geometry::in_single_precision(vertex));
            }
            e.hull = convex_hull(vertices);
        }
    }
    return elements;
}

} // namespace foam::inline runtime
