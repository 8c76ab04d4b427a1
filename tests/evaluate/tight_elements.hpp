// Elements around solids, just large enough.
#pragma once

#include "bisection.hpp"
#include "element_truth.hpp"
#include "geometry/plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <array>
#include <memory>
#include <ostream>
#include <vector>

namespace foam::test {

using Kind = Element::Kind;

inline constexpr std::array kinds{Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull};
enum class Inner { box, sphere, cylinder, capsule, mesh };
inline constexpr std::array inners{Inner::box, Inner::sphere, Inner::cylinder, Inner::capsule, Inner::mesh};

/// Facets of the polyhedron around a cylinder stick out of it by this share of the radius.
inline constexpr double facet = 0.0025;

struct Case {
    Solid::Part part;
    Element element;
    double size = 1, extent = 1; ///< of the solid; of that and its place

    std::shared_ptr<const Solid> solid() const { return Solid::make(std::vector{part}); }
    Elements view() const { return Elements(std::span(&element, 1)); }
    Quad outside() const { return Judge(element).outside(part); }
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
    const Element& e = c.element;
    out << (c.part.mesh ? "mesh" : to_string(c.part.primitive->kind)) << " in " << to_string(e.kind) << ", radius "
        << e.radius << ", half " << e.half.x << ' ' << e.half.y << ' ' << e.half.z;
    return out << ", size " << c.size << ", extent " << c.extent << ", outside " << static_cast<double>(c.outside());
}

/// The lengths that an element or a primitive of its kind has.
inline std::vector<double*> lengths(Element& e) {
    std::vector<double*> result;
    for (double* length : {&e.radius, &e.half.x, &e.half.y, &e.half.z}) {
        if (*length > 0) {
            result.push_back(length);
        }
    }
    return result;
}

inline Element scaled(Element e, double factor) {
    for (double* length : lengths(e)) {
        *length *= factor;
    }
    if (e.hull) {
        std::vector<Vec3> points = e.hull->surface.vertices;
        for (Vec3& p : points) {
            p = p * factor;
        }
        e.hull = convex_hull(points);
    }
    return e;
}

/// An element of about the size, at the origin.
inline Element element_of(Kind kind, double size, Random& random) {
    const auto length = [&] { return size * random.uniform(0.5, 1.5); };
    Element e{.kind = kind};
    if (kind != Kind::box && kind != Kind::hull) {
        e.radius = length();
    }
    if (kind == Kind::box || kind == Kind::swept_box) {
        e.half = {length(), length(), length()};
    } else if (kind == Kind::capsule || kind == Kind::cylinder) {
        e.half.z = length();
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k) {
            points.push_back(
                {k & 1 ? length() : -length(), k & 2 ? length() : -length(), k & 4 ? length() : -length()});
        }
        e.hull = convex_hull(points);
    }
    return e;
}

inline Solid::Part part_of(Inner inner, const Pose& pose, double size, Random& random) {
    const auto length = [&] { return size * random.uniform(0.5, 1.5); };
    Solid::Part part{nullptr, std::nullopt, pose};
    switch (inner) {
    case Inner::box:
        part.primitive = Element::box({length(), length(), length()});
        break;
    case Inner::sphere:
        part.primitive = Element::sphere(length());
        break;
    case Inner::cylinder:
        part.primitive = Element::cylinder(length(), length());
        break;
    case Inner::capsule:
        part.primitive = Element::capsule(length(), length());
        break;
    case Inner::mesh: {
        std::vector<Vec3> points;
        for (int k = 0; k < 10; ++k) {
            points.push_back(pose * (random_direction(random) * length()));
        }
        part.mesh = std::make_shared<const Mesh>(convex_hull(points)->surface);
        part.pose = {};
    }
    }
    return part;
}

/// Makes the element as small as contains the part to the last bit: first as a whole, then one length after another.
inline void tighten(Case& c) {
    const Extremes solid = extremes(c.part);
    const auto inside = [&](const Element& e) { return Judge(e).outside(solid) <= 0; };
    c.element = scaled(c.element, smallest(0.05, 50, [&](double f) { return inside(scaled(c.element, f)); }));
    for (double* length : lengths(c.element)) {
        const double whole = *length;
        *length = smallest(1e-3 * whole, whole, [&](double less) {
            *length = less;
            return inside(c.element);
        });
    }
}

inline void turn(Element& e, const Vec3& axis, double angle) {
    e.pose.rotation = (Pose::from_axis_angle(axis, angle) * Pose{e.pose.rotation, {}}).rotation;
}

} // namespace foam::test
