#include "cells.hpp"

#include "by_spheres/measured/occupancy.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::convex {
namespace {

struct Crease {
    double weight; ///< length times the sine of the angle
    Plane plane;
};

bool same_plane(const Plane& a, const Plane& b) {
    constexpr double cosine = 0.9995, distance = 2e-3;
    return dot(a.normal, b.normal) > cosine && std::abs(a.offset - b.offset) < distance;
}

/// Returns planes along the faces beside concave edges and between these, those of long and sharp edges first. Planes
/// that are nearly the same count once.
std::vector<Plane> creases_of(const Mesh& mesh) {
    std::vector<Vec3> normals;
    for (const Triangle& t : mesh.triangles) {
        normals.push_back(
            normalized(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]])));
    }
    std::vector<Crease> creases;
    for_each_edge(sides_by_edge(mesh.triangles, mesh.vertices.size()), [&](std::span<const Side> sides) {
        constexpr double least_sine = 0.1;
        if (sides.size() != 2 || sides[0].forward == sides[1].forward) {
            return;
        }
        const Side& side = sides[0].forward ? sides[0] : sides[1];
        const Side& other = sides[0].forward ? sides[1] : sides[0];
        const Vec3 &a = mesh.vertices[side.low], &b = mesh.vertices[side.high];
        const Vec3 &n = normals[side.triangle()], &m = normals[other.triangle()], along = normalized(b - a);
        const double sine = -dot(cross(n, m), along);
        if (sine < least_sine) {
            return;
        }
        const double weight = norm(b - a) * sine;
        for (Vec3 normal : {n, m, normalized(cross(normalized(n + m), along))}) {
            if (normal.x < 0 || (normal.x == 0 && (normal.y < 0 || (normal.y == 0 && normal.z < 0)))) {
                normal = -normal;
            }
            creases.push_back({weight, {normal, dot(normal, a)}});
        }
    });
    const auto heavier = [](const Crease& a, const Crease& b) { return a.weight > b.weight; };
    std::stable_sort(creases.begin(), creases.end(), heavier);
    std::vector<Crease> distinct;
    constexpr std::size_t most = 500;
    CancellationCounter asking(256);
    for (const Crease& crease : creases) {
        asking.check();
        const auto known = std::find_if(distinct.begin(), distinct.end(),
                                        [&](const Crease& d) { return same_plane(d.plane, crease.plane); });
        if (known != distinct.end()) {
            known->weight += crease.weight;
        } else if (distinct.size() < most) {
            distinct.push_back(crease);
        }
    }
    std::stable_sort(distinct.begin(), distinct.end(), heavier);
    std::vector<Plane> planes;
    for (const Crease& crease : distinct) {
        planes.push_back(crease.plane);
    }
    return planes;
}

/// Calls `visit` with the triangles that are segments or points, which welding drops.
template <class Visit> void for_each_without_area(const Mesh& mesh, Visit visit) {
    for (const Triangle& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            visit(corners);
        }
    }
}

/// Returns whether the surface is closed, and its parts do not overlap.
bool surface_tells_volume(const Polygons& surface, const Solid& solid, double unit) {
    constexpr double little = 2e-3; // the volume of several parts is integrated along lines
    const double by_surface = surface.cone_volume() * std::pow(unit, 3);
    return solid.closed() && std::abs(by_surface - solid.volume()) <= little * solid.volume();
}

/// Sets the points inside, and the volume that each stands for.
void set_samples(Body& body, const Solid& solid) {
    constexpr int resolution = 32;
    constexpr double units = 2; // of the occupancy in one of the body
    const by_spheres::Occupancy occupancy(solid, by_spheres::Frame(solid.bounds()), resolution);
    for (std::size_t i = 0; i < occupancy.inside().size(); ++i) {
        body.samples.push_back(occupancy.inside().at(i) / units);
    }
    body.sample_volume = std::pow(occupancy.cell() / units, 3);
}

} // namespace

BodyOfSolid body_of(const Solid& solid) {
    BodyOfSolid result;
    result.origin = solid.bounds().center();
    result.unit = solid.bounds().diagonal();
    const auto to_unit = [&](const Vec3& p) { return (p - result.origin) / result.unit; };
    Mesh mesh = welded(solid.surface());
    for (Vec3& p : mesh.vertices) {
        p = to_unit(p);
    }
    Body& body = result.body;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t i : t) {
            body.surface.corners.push_back(mesh.vertices[i]);
            body.vertices.push_back(i);
        }
        body.surface.close();
    }
    auto vertices = static_cast<std::uint32_t>(mesh.vertices.size());
    for_each_without_area(solid.surface(), [&](const std::array<Vec3, 3>& corners) {
        for (const Vec3& p : corners) {
            body.surface.corners.push_back(to_unit(p));
            body.vertices.push_back(vertices++);
        }
        body.surface.close();
    });
    body.has_inside = solid.volume() > 0;
    body.volumes_by_surface = surface_tells_volume(body.surface, solid, result.unit);
    if (body.has_inside && !body.volumes_by_surface) {
        set_samples(body, solid);
    }
    body.inside = [&solid, origin = result.origin, unit = result.unit](const Vec3& p) {
        return solid.contains(origin + p * unit);
    };
    body.creases = creases_of(mesh);
    return result;
}

std::vector<Brick> halved_bricks(const Body& body, std::size_t count) {
    HullOfPoints hull;
    std::vector<Brick> bricks{brick_around(hull, body.surface.corners, body.surface)};
    while (bricks.size() < count) {
        check_cancelled();
        const auto longest = [](const Box& box) { return std::max({box.size().x, box.size().y, box.size().z}); };
        const auto chosen = std::max_element(bricks.begin(), bricks.end(), [&](const Brick& a, const Brick& b) {
            return longest(a.box) < longest(b.box);
        });
        const Vec3 size = chosen->box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        Plane plane{{}, chosen->box.center()[axis]};
        plane.normal[axis] = 1;
        std::array<Polygons, 2> parts;
        cut(chosen->surface, plane, parts[0], parts[1]);
        if (parts[0].ends.empty() || parts[1].ends.empty()) {
            break;
        }
        *chosen = brick_around(hull, parts[0].corners, parts[0]);
        bricks.push_back(brick_around(hull, parts[1].corners, parts[1]));
    }
    return bricks;
}

} // namespace foam::inline search::convex
