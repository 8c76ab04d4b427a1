#include "cells.hpp"

namespace foam::inline search::convex {

void Polygons::append(const Polygons& other) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), other.corners.begin(), other.corners.end());
    for (const std::uint32_t end : other.ends) {
        ends.push_back(first + end);
    }
}

double Polygons::cone_volume() const {
    double sum = 0;
    std::uint32_t first = 0;
    for (const std::uint32_t end : ends) {
        for (std::uint32_t i = first + 2; i < end; ++i) {
            sum += dot(corners[first], cross(corners[i - 1], corners[i]));
        }
        first = end;
    }
    return sum / 6;
}

void cut(const Polygons& whole, const Plane& plane, Polygons& below, Polygons& above, std::vector<Vec3>* rim) {
    static thread_local std::vector<double> heights;
    std::uint32_t first = 0;
    for (const std::uint32_t end : whole.ends) {
        heights.clear();
        bool has_below = false, has_above = false;
        for (std::uint32_t i = first; i < end; ++i) {
            const double h = plane.height(whole.corners[i]);
            heights.push_back(std::abs(h) <= on_plane ? 0 : h);
            has_below = has_below || heights.back() < 0;
            has_above = has_above || heights.back() > 0;
        }
        const auto begin = whole.corners.begin() + first, stop = whole.corners.begin() + end;
        if (!has_above || !has_below) { // what lies in the plane is below
            Polygons& part = has_above ? above : below;
            part.corners.insert(part.corners.end(), begin, stop);
            part.close();
            if (rim && !has_above) { // edges in the plane
                for (std::uint32_t i = first; i < end; ++i) {
                    const std::uint32_t k = i + 1 < end ? i + 1 : first;
                    if (heights[i - first] == 0 && heights[k - first] == 0) {
                        rim->push_back(whole.corners[i]);
                        rim->push_back(whole.corners[k]);
                    }
                }
            }
            first = end;
            continue;
        }
        Vec3 from{}, to{}; // of the edge of the part below that lies in the plane
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint32_t k = i + 1 < end ? i + 1 : first;
            const Vec3 &a = whole.corners[i], &b = whole.corners[k];
            const double ha = heights[i - first], hb = heights[k - first];
            if (ha <= 0) {
                below.corners.push_back(a);
            }
            if (ha >= 0) {
                above.corners.push_back(a);
            }
            if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) {
                const Vec3 c = ha < 0 ? crossing(a, b, ha, hb) : crossing(b, a, hb, ha);
                below.corners.push_back(c);
                above.corners.push_back(c);
                (ha < 0 ? from : to) = c;
            } else if (ha == 0 && hb < 0) {
                to = a;
            } else if (hb == 0 && ha < 0) {
                from = b;
            }
        }
        below.close();
        above.close();
        if (rim) {
            rim->push_back(from);
            rim->push_back(to);
        }
        first = end;
    }
}

Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum{};
    for (const Vec3& p : points) {
        sum += p;
    }
    return sum / static_cast<double>(points.size());
}

/// Returns the vertices of a hull that was made of points, and its edges between them.
static Region region_of(const HullOfPoints& hull, const std::vector<Vec3>& points) {
    Region region;
    const std::vector<std::uint32_t> vertices = hull.vertices();
    std::vector<std::uint32_t> name(points.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        name[vertices[i]] = i;
        region.corners.push_back(points[vertices[i]]);
    }
    region.edges = hull.edges();
    for (auto& [a, b] : region.edges) {
        a = name[a];
        b = name[b];
    }
    return region;
}

Brick brick_around(HullOfPoints& hull, std::vector<Vec3> points, Polygons surface) {
    // The search needs no more corners than this, in units. Elements are made around the surface itself.
    constexpr double coarse = 1e-3;
    if (!hull.run(points, coarse)) { // thinner than that
        hull.run(points);
    }
    Region region = region_of(hull, points);
    Brick brick;
    for (const Vec3& p : region.corners) {
        brick.box.add(p);
    }
    brick.points = std::move(region.corners);
    brick.edges = std::move(region.edges);
    brick.surface = std::move(surface);
    return brick;
}

Region region_around(HullOfPoints& hull, const std::vector<Vec3>& corners) {
    hull.run(corners);
    return region_of(hull, corners);
}

/// Appends the corners of the parts of a convex region below and above a plane.
static void append_parts(std::span<const Vec3> corners, std::span<const std::array<std::uint32_t, 2>> edges,
                         const Plane& plane, std::vector<Vec3>& below, std::vector<Vec3>& above) {
    static thread_local std::vector<double> heights;
    heights.clear();
    bool has_below = false, has_above = false;
    for (const Vec3& p : corners) {
        const double h = plane.height(p);
        heights.push_back(h);
        has_below = has_below || h < -on_plane;
        has_above = has_above || h > on_plane;
    }
    if (!has_below || !has_above) {
        std::vector<Vec3>& part = has_above ? above : below;
        part.insert(part.end(), corners.begin(), corners.end());
        return;
    }
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (heights[i] <= on_plane) {
            below.push_back(corners[i]);
        }
        if (heights[i] >= -on_plane) {
            above.push_back(corners[i]);
        }
    }
    for (const auto& [a, b] : edges) {
        if ((heights[a] < -on_plane && heights[b] > on_plane) || (heights[a] > on_plane && heights[b] < -on_plane)) {
            const Vec3 c = crossing(corners[a], corners[b], heights[a], heights[b]);
            below.push_back(c);
            above.push_back(c);
        }
    }
}

std::array<std::vector<Region>, 2> cut(HullOfPoints& hull, std::span<const Region> regions, const Plane& plane) {
    std::array<std::vector<Region>, 2> parts;
    for (const Region& region : regions) {
        std::array<std::vector<Vec3>, 2> corners;
        append_parts(region.corners, region.edges, plane, corners[0], corners[1]);
        for (std::size_t side = 0; side < 2; ++side) {
            if (!corners[side].empty()) {
                parts[side].push_back(region_around(hull, corners[side]));
            }
        }
    }
    return parts;
}

std::array<Brick, 2> cut(HullOfPoints& hull, const Brick& brick, const Plane& plane) {
    std::array<std::vector<Vec3>, 2> points;
    std::array<Polygons, 2> surface;
    append_parts(brick.points, brick.edges, plane, points[0], points[1]);
    cut(brick.surface, plane, surface[0], surface[1]);
    for (std::size_t side = 0; side < 2; ++side) { // flat bricks have no edges to be cut
        points[side].insert(points[side].end(), surface[side].corners.begin(), surface[side].corners.end());
    }
    std::array<Brick, 2> parts{brick_around(hull, std::move(points[0]), std::move(surface[0])),
                               brick_around(hull, std::move(points[1]), std::move(surface[1]))};
    std::array<std::vector<Region>, 2> regions = cut(hull, brick.regions, plane);
    parts[0].regions = std::move(regions[0]);
    parts[1].regions = std::move(regions[1]);
    return parts;
}

} // namespace foam::inline search::convex
