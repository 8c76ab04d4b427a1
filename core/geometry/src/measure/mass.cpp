#include <foam/geometry/volumes.hpp>

#include "convex/kind.hpp"
#include "mesh/line_grid.hpp"

#include <foam/base/cancellation.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

constexpr std::array<std::pair<int, int>, 6> entries{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Integrals over a body about a reference point: of 1, of p, and of the products of the coordinates of p in the order
/// of `entries`.
struct Moments {
    double volume = 0;
    Vec3 first;
    std::array<double, 6> second{};

    void add(const Moments& other, double weight = 1) {
        volume += weight * other.volume;
        first += weight * other.first;
        for (std::size_t i = 0; i < second.size(); ++i) {
            second[i] += weight * other.second[i];
        }
    }
};

/// Returns the moments of the tetrahedron of the origin and a triangle, negative if it is wound inwards.
Moments of_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c) {
    Moments moments;
    moments.volume = dot(a, cross(b, c)) / 6;
    const Vec3 sum = a + b + c;
    moments.first = sum * (moments.volume / 4);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto [j, k] = entries[i];
        moments.second[i] = moments.volume / 20 * (a[j] * a[k] + b[j] * b[k] + c[j] * c[k] + sum[j] * sum[k]);
    }
    return moments;
}

/// Returns the moments of a primitive about `reference`; `squares`: its second moments.
Moments of_primitive(const Element& primitive, const Vec3& squares, const Pose& pose, const Vec3& reference) {
    Moments moments;
    moments.volume = volume(primitive);
    const Vec3 center = pose.translation - reference;
    moments.first = center * moments.volume;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto [j, k] = entries[i];
        const Vec3& a = pose.rotation[static_cast<std::size_t>(j)];
        const Vec3& b = pose.rotation[static_cast<std::size_t>(k)];
        moments.second[i] = a.x * b.x * squares.x + a.y * b.y * squares.y + a.z * b.z * squares.z +
                            moments.volume * center[j] * center[k];
    }
    return moments;
}

/// Returns the sum over the parts: those of the solid where its parts are closed and do not overlap.
Moments of_parts(const Solid& solid, const Vec3& reference) {
    Moments moments;
    const Mesh& surface = solid.surface();
    CancellationCounter asking(1024);
    for (std::size_t part = 0; part < solid.parts().size(); ++part) {
        const std::optional<Element>& primitive = solid.parts()[part].primitive;
        if (const auto squares = primitive ? kind_of(*primitive).second_moments(*primitive) : std::nullopt) {
            moments.add(of_primitive(*primitive, *squares, solid.parts()[part].pose, reference));
            continue;
        }
        for (std::uint32_t i = solid.part_offsets()[part]; i < solid.part_offsets()[part + 1]; ++i) {
            asking.check();
            const auto& [a, b, c] = surface.triangles[i];
            const auto corner = [&](std::uint32_t vertex) { return surface.vertices[vertex] - reference; };
            moments.add(of_tetrahedron(corner(a), corner(b), corner(c)));
        }
    }
    return moments;
}

/// Returns the moments of the part of a line inside, per area across the line.
Moments of_piece(const Solid::Interval& interval, const Vec3& origin, int axis) {
    const double from = origin[axis] + interval.enter, to = origin[axis] + interval.leave;
    Vec3 middle = origin;
    middle[axis] = (from + to) / 2;
    Moments moments;
    moments.volume = to - from;
    moments.first = middle * moments.volume;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto [j, k] = entries[i];
        moments.second[i] = moments.volume * middle[j] * middle[k];
        if (j == axis && k == axis) {
            moments.second[i] += moments.volume * moments.volume * moments.volume / 12;
        }
    }
    return moments;
}

/// Integrates along lines parallel to each axis.
Moments of_lines(const Solid& solid, const Vec3& reference) {
    constexpr std::size_t across = 64;
    Moments moments;
    for (int axis = 0; axis < 3; ++axis) {
        const LineGrid grid(solid.bounds(), axis, across, "mass");
        for (const Line& line : grid.lines) {
            check_cancelled();
            for (const Solid::Interval& interval : solid.inside_along(line.origin(), line.direction())) {
                moments.add(of_piece(interval, line.origin() - reference, axis), grid.cell_area() / 3);
            }
        }
    }
    return moments;
}

} // namespace

std::optional<MassProperties> mass_properties(const Solid& solid, double density) {
    constexpr double same = 1e-6; // far above rounding, far below what an overlap makes
    const Vec3 reference = solid.bounds().center();
    const double volume = solid.volume();
    Moments moments = of_parts(solid, reference);
    if (!solid.closed() || !(std::abs(moments.volume - volume) <= same * volume)) {
        moments = of_lines(solid, reference);
    }
    if (!(volume > 0) || !(moments.volume > 0)) {
        return {};
    }
    MassProperties result;
    result.mass = density * volume;
    const Vec3 center = moments.first / moments.volume;
    result.center = reference + center;
    std::array<double, 6> spread{}; // mean products of the coordinates about the centre
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto [j, k] = entries[i];
        spread[i] = moments.second[i] / moments.volume - center[j] * center[k];
    }
    result.inertia = {spread[1] + spread[2], spread[0] + spread[2], spread[0] + spread[1],
                      0 - spread[3],         0 - spread[4],         0 - spread[5]}; // never -0
    for (double& value : result.inertia) {
        value *= result.mass;
    }
    return result;
}

} // namespace foam::geometry
