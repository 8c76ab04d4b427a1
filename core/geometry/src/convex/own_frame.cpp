#include <foam/geometry/internal/own_frame.hpp>

#include <fmt/format.h>

namespace foam::inline geometry {
namespace {

/// Bounds of ordinary geometry as powers of two: sizes in m, and the distance in sizes.
constexpr int least_ordinary_size = -20, largest_ordinary_size = 20, ordinary_place = 10;
/// Exponent relative to the size. In-sphere predicates are of degree five: above this their products do not underflow.
constexpr int dust_exponent = -200;
/// Exponent relative to a part's size; parts are up to 2^70 times smaller than the whole.
constexpr int possible_dust_exponent = dust_exponent + 70;

Vec3 middle_of(const Box& box) {
    return box.low * 0.5 + box.high * 0.5;
}

/// Returns the length without intermediate overflow.
double length_of(const Vec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 && std::isfinite(largest) ? norm(v / largest) * largest : largest;
}

template <class Convert> Mesh converted(Mesh mesh, const Convert& convert) {
    for (Vec3& vertex : mesh.vertices) {
        vertex = convert(vertex);
    }
    return mesh;
}

/// Returns the element with its lengths multiplied by a power of two: exact.
Element scaled(Element element, double factor) {
    element.half *= factor;
    element.radius *= factor;
    if (element.hull && factor != 1) {
        auto hull = std::make_shared<Polytope>(*element.hull);
        for (Vec3& vertex : hull->surface.vertices) {
            vertex *= factor;
        }
        for (Polytope::Face& face : hull->faces) {
            face.offset *= factor;
        }
        element.hull = std::move(hull);
    }
    return element;
}

} // namespace

double size_of(const Box& box) {
    return length_of(box.size());
}

std::string why_bad_size(double size) {
    if (size == 0) {
        return "all of its points are one point: there is nothing to cover; remedy: check its scale, or leave it out";
    }
    if (!(size <= largest_size)) {
        return fmt::format("its size is {:.3g} m, more than the {:g} m up to which spheres can be proved to cover it; "
                           "remedy: check its unit and scale",
                           size, largest_size);
    }
    if (size < smallest_size) {
        return fmt::format(
            "its size is {:.3g} m, less than the {:g} m down to which spheres can be proved to cover it; "
            "remedy: check its unit and scale",
            size, smallest_size);
    }
    return "";
}

std::string why_bad_place(const Vec3& middle, double size) {
    const double away = length_of(middle);
    if (!(away <= farthest_place * size)) {
        return fmt::format(
            "it is {:.3g} m from the origin of its frame, more than {:g} times its size of {:.3g} m: the "
            "numbers cannot hold its form there; remedy: move it nearer, or check its unit and scale",
            away, farthest_place, size);
    }
    return "";
}

std::string why_out_of_bounds(const Box& box) {
    const double size = size_of(box);
    const std::string why = why_bad_size(size);
    return why.empty() ? why_bad_place(middle_of(box), size) : why;
}

Box bounds_of_corners(const Mesh& mesh) {
    Box box;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            box.add(mesh.vertices[corner]);
        }
    }
    return box;
}

double OwnFrame::scale() const {
    return std::ldexp(1.0, exponent);
}

Vec3 OwnFrame::to_own(const Vec3& point) const {
    Vec3 own = (point - origin) * scale();
    for (int axis = 0; axis < 3; ++axis) {
        own[axis] = std::abs(own[axis]) < dust ? 0 : own[axis];
    }
    return own;
}

Vec3 OwnFrame::from_own(const Vec3& point) const {
    return point * std::ldexp(1.0, -exponent) + origin;
}

Mesh OwnFrame::to_own(Mesh mesh) const {
    return converted(std::move(mesh), [&](const Vec3& v) { return to_own(v); });
}

Mesh OwnFrame::from_own(Mesh mesh) const {
    return converted(std::move(mesh), [&](const Vec3& v) { return from_own(v); });
}

std::shared_ptr<const Solid> OwnFrame::to_own(const Solid& solid) const {
    std::vector<Solid::Part> parts = solid.parts();
    for (Solid::Part& part : parts) {
        if (part.primitive) {
            part.pose.translation = to_own(part.pose.translation);
            *part.primitive = scaled(*part.primitive, scale());
        } else {
            part.mesh = std::make_shared<const Mesh>(to_own(*part.mesh));
        }
    }
    return Solid::make(std::move(parts));
}

Shape OwnFrame::to_own(const Shape& shape) const {
    const std::shared_ptr<const Solid> original = to_own(shape.original());
    return {shape.name(), &shape.processed() == &shape.original() ? original : to_own(shape.processed()), original};
}

std::vector<Sphere> OwnFrame::from_own(std::vector<Sphere> spheres) const {
    for (Sphere& sphere : spheres) {
        sphere = {from_own(sphere.center), sphere.radius * std::ldexp(1.0, -exponent)};
    }
    return spheres;
}

Element OwnFrame::from_own(Element element) const {
    element.pose.translation = from_own(element.pose.translation);
    return scaled(std::move(element), std::ldexp(1.0, -exponent));
}

Approximation OwnFrame::from_own(Approximation tree) const {
    for (Approximation::Level& level : tree.levels) {
        level.elements.spheres() = from_own(std::move(level.elements.spheres()));
        for (Element& element : level.elements.shaped()) {
            element = from_own(std::move(element));
        }
    }
    return tree;
}

bool may_have_dust(const Mesh& mesh) {
    const double least = std::ldexp(size_of(bounds_of_corners(mesh)), possible_dust_exponent);
    const auto is_dust = [&](double value) { return value != 0 && std::abs(value) < least; };
    return std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                       [&](const Vec3& v) { return is_dust(v.x) || is_dust(v.y) || is_dust(v.z); });
}

OwnFrame own_frame(const Box& box, bool dusty) {
    OwnFrame frame;
    const double size = size_of(box);
    if (!(size > 0) || !std::isfinite(size)) {
        return frame; // another frame would not help
    }
    const int magnitude = std::ilogb(size);
    if (magnitude < least_ordinary_size || magnitude >= largest_ordinary_size) {
        frame.exponent = -magnitude;
    }
    const Vec3 middle = middle_of(box);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(middle[axis]) > std::ldexp(size, ordinary_place)) {
            frame.origin[axis] = middle[axis];
        }
    }
    if (dusty) {
        frame.dust = std::ldexp(size, dust_exponent + frame.exponent);
    }
    return frame;
}

OwnFrame own_frame(const Mesh& mesh) {
    return own_frame(bounds_of_corners(mesh), may_have_dust(mesh));
}

OwnFrame own_frame(const Solid& solid) {
    const bool dusty = std::any_of(solid.parts().begin(), solid.parts().end(),
                                   [](const Solid::Part& part) { return part.mesh && may_have_dust(*part.mesh); });
    return own_frame(solid.bounds(), dusty);
}

} // namespace foam::geometry
