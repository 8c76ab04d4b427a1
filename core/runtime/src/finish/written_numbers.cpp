#include "finish/finish.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

namespace foam::inline runtime {
namespace {

/// Returns the hull of the vertices on the grid, in the link's frame.
Element hull_on_grid(Element element, const DecimalGrid& grid) {
    std::vector<Vec3> vertices;
    for (const Vec3& vertex : element.hull->surface.vertices) {
        vertices.push_back(grid.nearest(element.pose * vertex));
    }
    element.hull = convex_hull(vertices);
    element.pose = {};
    return element;
}

/// Returns a length that no vertex moves farther by on its way to the grid. A hull that is grown by it contains the
/// hull that it was, wherever its vertices move to: no support value falls by more.
double farthest_move(const DecimalGrid& grid) {
    constexpr double half_diagonal = std::numbers::sqrt3 / 2, rounding = 1.01;
    return half_diagonal * rounding * grid.step();
}

/// Returns the element at the nearest place on the grid.
Element on_grid(Element element, const DecimalGrid& grid) {
    if (element.kind != Element::Kind::hull) {
        element.pose.translation = grid.nearest(element.pose.translation);
        return element;
    }
    try {
        return hull_on_grid(element, grid);
    } catch (const Error&) { // thinner than the step of the grid
        return up_on_grid(std::move(element), grid);
    }
}

/// Returns how far the numbers of a file may move the element's surface: an orientation is read back from angles or a
/// quaternion, ends of a capsule from its middle, and all of them perhaps in single precision.
double slack_of(const Element& element, Numbers numbers) {
    const bool turned = element.pose.rotation != Pose{}.rotation;
    const bool by_middle = element.kind != Element::Kind::capsule && element.kind != Element::Kind::cylinder;
    const Box box = bounds(element);
    const Vec3 far{std::max(-box.low.x, box.high.x), std::max(-box.low.y, box.high.y),
                   std::max(-box.low.z, box.high.z)};
    constexpr double orientation = 1e-12, single = 8 * std::numeric_limits<float>::epsilon();
    return norm(far) * (numbers == Numbers::float32 ? single : turned || !by_middle ? orientation : 0);
}

/// Returns how far `after` extends beyond `before`, m: of their lengths, or of the vertices of hulls.
double growth_between(const Element& before, const Element& after) {
    double growth = after.radius - before.radius;
    for (int axis = 0; axis < 3; ++axis) {
        growth = std::max(growth, after.half[axis] - before.half[axis]);
    }
    if (after.hull) {
        for (const Vec3& vertex : after.hull->surface.vertices) {
            growth = std::max(growth, distance(before, after.pose * vertex));
        }
    }
    return growth;
}

double growth_between(const Elements& before, const Elements& after) {
    double growth = 0;
    for (std::size_t i = 0; i < after.spheres().size(); ++i) {
        growth = std::max(growth, after.spheres()[i].radius - before.spheres()[i].radius);
    }
    for (std::size_t i = 0; i < after.shaped().size(); ++i) {
        growth = std::max(growth, growth_between(before.shaped()[i], after.shaped()[i]));
    }
    return growth;
}

} // namespace

double float32_slack(const Sphere& sphere, Numbers numbers) {
    const double largest =
        std::max({std::abs(sphere.center.x), std::abs(sphere.center.y), std::abs(sphere.center.z), sphere.radius});
    return numbers == Numbers::float32 ? 2 * std::numeric_limits<float>::epsilon() * largest : 0;
}

Element up_on_grid(Element element, const DecimalGrid& grid) {
    if (element.kind == Element::Kind::hull) {
        return grid.step() > 0 ? hull_on_grid(grown(element, farthest_move(grid)), grid) : element;
    }
    for (int axis = 0; axis < 3; ++axis) {
        element.half[axis] = grid.up(element.half[axis]);
    }
    element.radius = grid.up(element.radius);
    if (element.kind == Element::Kind::capsule && !(element.half.z > 0)) { // formats take it for a sphere
        element.half.z = std::max(grid.step(), 1e-6 * element.radius);
    }
    return element;
}

/// Returns the elements with numbers on the grid, grown by no less than they move to it: they contain the given ones.
static Elements grown_onto_grid(Elements elements, const DecimalGrid& grid) {
    const double move = farthest_move(grid);
    for (Sphere& sphere : elements.spheres()) {
        sphere = {grid.nearest(sphere.center), sphere.radius + move};
    }
    for (Element& element : elements.shaped()) {
        if (element.kind == Element::Kind::hull) {
            element = up_on_grid(std::move(element), grid);
        } else {
            element = grown(element, move);
            element.pose.translation = grid.nearest(element.pose.translation);
        }
    }
    return elements;
}

/// Rounds the lengths of an element's numbers up to the grid, after a growth for what the numbers of a file lose.
static Element with_written_numbers(Element element, const Element& placed, const DecimalGrid& grid, double slack) {
    element = grown(element, slack);
    const bool on_grid_already = element.kind == Element::Kind::hull && element == placed;
    return on_grid_already ? element : up_on_grid(std::move(element), grid);
}

static bool has_hulls(const Elements& elements) {
    return std::any_of(elements.shaped().begin(), elements.shaped().end(),
                       [](const Element& element) { return element.kind == Element::Kind::hull; });
}

/// Returns whether the elements are proved to cover, also with their hulls as the files of meshes have them. Those
/// contain the hulls, but the proof goes by other pieces.
static bool covers_as_meshes(const Solid& solid, Elements elements) {
    try {
        for (Element& element : elements.shaped()) {
            element = element.kind == Element::Kind::hull ? float32_hull(element) : element;
        }
    } catch (const Error&) {
        return true; // no such file can be written, which a writer says
    }
    return covers(solid, elements);
}

void grow_until_proved(const Solid& solid, Elements& elements, const DecimalGrid& grid) {
    constexpr int rounds = 12;
    constexpr double least = 1e-10; // of the size
    const auto proved = [&] {
        return covers(solid, elements) && (!has_hulls(elements) || covers_as_meshes(solid, elements));
    };
    for (int round = 0; round < rounds && !proved(); ++round) {
        const double length = std::ldexp(std::max(grid.step(), least * solid.bounds().diagonal()), round);
        for (Sphere& sphere : elements.spheres()) {
            sphere.radius = grid.up(sphere.radius + length);
        }
        for (Element& element : elements.shaped()) {
            element = up_on_grid(grown(element, length), grid);
        }
    }
}

double finish_elements(const Solid& solid, Elements& elements, const DecimalGrid& grid, bool outer, Numbers numbers) {
    const Elements given = elements;
    for (Sphere& sphere : elements.spheres()) {
        sphere.center = grid.nearest(sphere.center);
    }
    for (Element& element : elements.shaped()) {
        element = on_grid(std::move(element), grid);
    }
    Elements placed = elements;
    if (outer && !covers(solid, elements)) {
        placed = grown_onto_grid(given, grid); // much quicker than to find what their moves to the grid have opened
        elements = grown_to_cover(solid, placed);
    }
    for (Sphere& sphere : elements.spheres()) {
        sphere.radius = grid.up(sphere.radius + (outer ? float32_slack(sphere, numbers) : 0));
    }
    for (std::size_t i = 0; i < elements.shaped().size(); ++i) {
        Element& element = elements.shaped()[i];
        const double slack = outer ? slack_of(element, numbers) : 0;
        element = with_written_numbers(std::move(element), placed.shaped()[i], grid, slack);
    }
    if (outer && (has_hulls(elements) || !(elements == placed))) {
        grow_until_proved(solid, elements, grid);
    }
    return growth_between(given, elements);
}

} // namespace foam::runtime
