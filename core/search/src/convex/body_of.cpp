#include "cells.hpp"

#include "by_spheres/measured/occupancy.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/solids.hpp>
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

/// Returns the planes of the flat parts of the surface that are a share of it, large ones first: sheets of metal meet
/// there.
std::vector<Plane> faces_of(const Mesh& mesh) {
    constexpr double share = 0.05;
    constexpr std::size_t most = 12, most_triangles = 20'000; // finer meshes are round
    if (mesh.triangles.size() > most_triangles) {
        return {};
    }
    std::vector<Crease> found; // weighed by their area
    double all = 0;
    CancellationCounter asking(256);
    for (const Triangle& t : mesh.triangles) {
        asking.check();
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 across = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        const double area = norm(across);
        all += area;
        if (!(area > 0)) {
            continue;
        }
        Vec3 normal = across / area;
        if (normal.x < 0 || (normal.x == 0 && (normal.y < 0 || (normal.y == 0 && normal.z < 0)))) {
            normal = -normal;
        }
        const Plane plane{normal, dot(normal, a)};
        const auto known = std::find_if(found.begin(), found.end(), [&](const Crease& f) {
            return dot(f.plane.normal, normal) > 1 - 1e-9 && std::abs(f.plane.offset - plane.offset) < 1e-7;
        });
        if (known != found.end()) {
            known->weight += area;
        } else if (found.size() < 40 * most) {
            found.push_back({area, plane});
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const Crease& a, const Crease& b) { return a.weight > b.weight; });
    std::vector<Plane> planes;
    for (const Crease& face : found) {
        if (planes.size() < most && face.weight > share * all) {
            planes.push_back(face.plane);
        }
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
    body.is_filled = body.has_inside && geometry::has_solid_parts(solid);
    body.volumes_by_surface = surface_tells_volume(body.surface, solid, result.unit);
    if (body.has_inside && !body.volumes_by_surface) {
        set_samples(body, solid);
    }
    body.inside = [&solid, origin = result.origin, unit = result.unit](const Vec3& p) {
        return solid.contains(origin + p * unit);
    };
    body.creases = creases_of(mesh);
    body.faces = faces_of(mesh);
    return result;
}

void add_corners_inside(const Body& body, std::span<const Vec3> corners, std::vector<Vec3>& points) {
    constexpr double inwards = 1e-6; // of the way to the middle of the region
    const Vec3 middle = mean_of(corners);
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(points),
                 [&](const Vec3& p) { return body.inside(p + (middle - p) * inwards); });
}

/// A brick of halved space, and the box that it was cut from.
struct Halved {
    Brick brick;
    Box cell;
};

/// Returns the corners of a box.
static std::vector<Vec3> corners_of(const Box& box) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) {
        corners.push_back(
            {k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y, k & 4 ? box.high.z : box.low.z});
    }
    return corners;
}

/// Returns the brick of a part of the surface and of what is inside the regions; without points if there is nothing.
static Brick brick_of(const Body& body, HullOfPoints& hull, Polygons surface, std::vector<Region> regions) {
    if (surface.ends.empty() && (regions.empty() || !body.inside(mean_of(regions.front().corners)))) {
        return {};
    }
    std::vector<Vec3> points = surface.corners;
    for (const Region& region : regions) {
        add_corners_inside(body, region.corners, points);
    }
    if (points.empty()) {
        return {};
    }
    Brick brick = brick_around(hull, std::move(points), std::move(surface));
    brick.regions = std::move(regions);
    return brick;
}

/// Returns the brick of a box.
static Brick brick_in(const Body& body, HullOfPoints& hull, Polygons surface, const Box& cell) {
    std::vector<Region> regions;
    if (body.is_filled) {
        regions.push_back(region_around(hull, corners_of(cell)));
    }
    return brick_of(body, hull, std::move(surface), std::move(regions));
}

/// Cuts bricks along the plane of a large flat part of the surface: what sheets that meet there have of them is convex
/// then.
static void cut_along(const Body& body, HullOfPoints& hull, const Plane& face, std::vector<Brick>& bricks) {
    const std::size_t count = bricks.size();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<Polygons, 2> surface;
        cut(bricks[i].surface, face, surface[0], surface[1]);
        std::array<std::vector<Region>, 2> regions = cut(hull, bricks[i].regions, face);
        std::array<Brick, 2> parts;
        for (std::size_t side = 0; side < 2; ++side) {
            parts[side] = brick_of(body, hull, std::move(surface[side]), std::move(regions[side]));
        }
        if (!parts[0].points.empty() && !parts[1].points.empty()) {
            bricks.push_back(std::move(parts[1]));
            bricks[i] = std::move(parts[0]);
        }
    }
}

std::vector<Brick> halved_bricks(const Body& body, std::size_t count) {
    HullOfPoints hull;
    Box all;
    for (const Vec3& p : body.surface.corners) {
        all.add(p);
    }
    std::vector<Halved> made{{brick_in(body, hull, body.surface, all), all}};
    std::size_t with_surface = 1;
    while (with_surface < count) {
        check_cancelled();
        const auto longest = [](const Brick& brick) {
            constexpr double inside = 0.75; // bricks without surface need not be fine
            const Vec3 size = brick.box.size();
            return std::max({size.x, size.y, size.z}) * (brick.surface.ends.empty() ? inside : 1);
        };
        const auto chosen = std::max_element(made.begin(), made.end(), [&](const Halved& a, const Halved& b) {
            return longest(a.brick) < longest(b.brick);
        });
        const Vec3 size = chosen->brick.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        Plane plane{{}, chosen->brick.box.center()[axis]};
        plane.normal[axis] = 1;
        std::array<Polygons, 2> parts;
        cut(chosen->brick.surface, plane, parts[0], parts[1]);
        std::array<Box, 2> cells{chosen->cell, chosen->cell};
        cells[0].high[axis] = cells[1].low[axis] = plane.offset;
        std::array<Brick, 2> halves;
        for (std::size_t side = 0; side < 2; ++side) {
            halves[side] = brick_in(body, hull, parts[side], cells[side]);
        }
        if (halves[0].points.empty() || halves[1].points.empty()) {
            break;
        }
        with_surface -= !chosen->brick.surface.ends.empty();
        with_surface += !parts[0].ends.empty();
        with_surface += !parts[1].ends.empty();
        *chosen = {std::move(halves[0]), cells[0]};
        made.push_back({std::move(halves[1]), cells[1]});
    }
    std::vector<Brick> bricks;
    for (Halved& half : made) {
        bricks.push_back(std::move(half.brick));
    }
    for (const Plane& face : body.faces) {
        cut_along(body, hull, face, bricks);
    }
    return bricks;
}

} // namespace foam::inline search::convex
