#include "cells.hpp"
#include "pieces.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline search::convex {
namespace {

/// Where the distinct points of a cell's surface are, and the edges between them.
struct PointsAndEdges {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

PointsAndEdges distinct(const Polygons& surface) {
    std::vector<std::uint32_t> order(surface.corners.size()), name(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    const auto key = [&](std::uint32_t i) {
        const Vec3& p = surface.corners[i];
        return std::tie(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    PointsAndEdges result;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) {
            result.points.push_back(surface.corners[order[i]]);
        }
        name[order[i]] = static_cast<std::uint32_t>(result.points.size() - 1);
    }
    std::uint32_t first = 0;
    for (const std::uint32_t end : surface.ends) {
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint32_t a = name[i], b = name[i + 1 < end ? i + 1 : first];
            if (a != b) {
                result.edges.push_back({std::min(a, b), std::max(a, b)});
            }
        }
        first = end;
    }
    std::sort(result.edges.begin(), result.edges.end());
    result.edges.erase(std::unique(result.edges.begin(), result.edges.end()), result.edges.end());
    return result;
}

/// A convex cell of space with the parts of the surface, and of the planes between cells, that bound the body in it.
struct SpaceCell {
    Polygons faces; ///< of the cell
    Polygons surface, caps;
    PointsAndEdges corners;    ///< of the cell, where they are inside the body, and edges between these
    std::vector<Vec3> vacant;  ///< corners that are not inside
    std::vector<Vec3> samples; ///< of the body, in the cell
    double hull_volume = 0, excess = 0;
};

/// Appends the polygon in the plane around points that are the corners of a convex one.
void append_face(std::vector<Vec3> corners, const Plane& plane, bool upwards, Polygons& faces) {
    if (corners.size() < 3) {
        return;
    }
    Vec3 middle{};
    for (const Vec3& p : corners) {
        middle += p / static_cast<double>(corners.size());
    }
    const Vec3 x = normalized(corners.front() - middle), y = cross(plane.normal, x);
    std::sort(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) {
        return std::atan2(dot(a - middle, y), dot(a - middle, x)) < std::atan2(dot(b - middle, y), dot(b - middle, x));
    });
    if (!upwards) {
        std::reverse(corners.begin(), corners.end());
    }
    faces.corners.insert(faces.corners.end(), corners.begin(), corners.end());
    faces.close();
}

class Cutting {
public:
    Cutting(const Body& body, std::size_t most) : body_(body), most_(most) {}

    std::vector<Brick> run() {
        cells_.push_back(whole());
        double threshold = std::max(cells_.front().excess, 0.0) / 4;
        constexpr double finest = 1e-5; // of the hull of the whole
        const double least = finest * cells_.front().hull_volume;
        while (cells_.size() < most_ && threshold > least) {
            while (cells_.size() < most_ && round(threshold)) {
            }
            threshold /= 2;
        }
        std::vector<Brick> bricks(cells_.size());
        parallel_for(cells_.size(), [&](std::size_t i) { bricks[i] = brick_of(cells_[i]); });
        std::erase_if(bricks, [](const Brick& b) { return b.points.empty(); });
        return bricks;
    }

private:
    SpaceCell whole() const {
        SpaceCell cell;
        cell.surface = body_.surface;
        cell.samples = body_.samples;
        Box box;
        for (const Vec3& p : cell.surface.corners) {
            box.add(p);
        }
        const Vec3 beyond = Vec3{1, 1, 1} * 0.01;
        const Vec3 a = box.low - beyond, b = box.high + beyond;
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool high : {false, true}) {
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                for (int k = 0; k < 4; ++k) {
                    const int turn = high ? k : 3 - k;
                    Vec3 p;
                    p[axis] = high ? b[axis] : a[axis];
                    p[u] = turn == 1 || turn == 2 ? b[u] : a[u];
                    p[v] = turn >= 2 ? b[v] : a[v];
                    cell.faces.corners.push_back(p);
                }
                cell.faces.close();
            }
        }
        judge(cell, {});
        return cell;
    }
    /// Finds which corners of a cell are inside, and its excess. `before`: the cell that it is a part of.
    void judge(SpaceCell& cell, const SpaceCell& before) const {
        if (body_.has_inside) {
            set_corners(cell, before);
        }
        std::vector<Vec3> points = cell.surface.corners;
        points.insert(points.end(), cell.corners.points.begin(), cell.corners.points.end());
        cell.hull_volume = volume_of_hull(points);
        const double filled = body_.volumes_by_surface ? cell.surface.cone_volume() + cell.caps.cone_volume()
                                                       : body_.sample_volume * static_cast<double>(cell.samples.size());
        cell.excess = cell.hull_volume - std::clamp(filled, 0.0, cell.hull_volume);
    }
    void set_corners(SpaceCell& cell, const SpaceCell& before) const {
        const PointsAndEdges all = distinct(cell.faces);
        constexpr std::uint32_t outside = 0xFFFFFFFFu;
        std::vector<std::uint32_t> name(all.points.size(), outside);
        const auto is_in = [](const std::vector<Vec3>& some, const Vec3& p) {
            return std::find(some.begin(), some.end(), p) != some.end();
        };
        for (std::size_t i = 0; i < all.points.size(); ++i) {
            const Vec3& p = all.points[i];
            const bool inside = is_in(before.corners.points, p) || (!is_in(before.vacant, p) && body_.inside(p));
            if (inside) {
                name[i] = static_cast<std::uint32_t>(cell.corners.points.size());
            }
            (inside ? cell.corners.points : cell.vacant).push_back(p);
        }
        for (const auto& [a, b] : all.edges) {
            if (name[a] != outside && name[b] != outside) {
                cell.corners.edges.push_back({name[a], name[b]});
            }
        }
    }
    /// Cuts the cells with more excess than the threshold, all at once. Returns false if there are none.
    bool round(double threshold) {
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < cells_.size() && cells_.size() + chosen.size() < most_; ++i) {
            if (cells_[i].excess > threshold) {
                chosen.push_back(i);
            }
        }
        std::vector<std::array<SpaceCell, 2>> parts(chosen.size());
        parallel_for(chosen.size(), [&](std::size_t k) { parts[k] = halves(cells_[chosen[k]]); });
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            cells_[chosen[k]] = std::move(parts[k][0]);
            if (!parts[k][1].surface.ends.empty() || !parts[k][1].corners.points.empty()) {
                cells_.push_back(std::move(parts[k][1]));
            }
        }
        return !chosen.empty();
    }
    std::vector<Plane> candidates(const std::vector<Vec3>& points) const {
        std::vector<Plane> planes;
        constexpr std::size_t directions = 18;
        for (const Vec3& normal : fibonacci_directions(directions)) {
            if (normal.z < 0) {
                continue;
            }
            const auto [low, high] =
                std::minmax_element(points.begin(), points.end(),
                                    [&](const Vec3& a, const Vec3& b) { return dot(a, normal) < dot(b, normal); });
            const double a = dot(*low, normal), b = dot(*high, normal);
            for (const double share : {0.25, 0.5, 0.75}) {
                planes.push_back({normal, a + (b - a) * share});
            }
        }
        std::size_t taken = 0;
        constexpr std::size_t most_creases = 12;
        for (std::size_t i = 0; i < body_.creases.size() && taken < most_creases; ++i) {
            if (passes_through(body_.creases[i], points)) {
                planes.push_back(body_.creases[i]);
                ++taken;
            }
        }
        return planes;
    }
    static bool passes_through(const Plane& plane, const std::vector<Vec3>& points) {
        bool below = false, above = false;
        constexpr double clearly = 1e-4;
        for (const Vec3& p : points) {
            const double h = plane.height(p);
            below = below || h < -clearly;
            above = above || h > clearly;
            if (below && above) {
                return true;
            }
        }
        return false;
    }
    /// Returns what finds the corners that a plane makes of a cell's edges, as far as they are inside the body.
    PointsInPlane corners_in_plane(const SpaceCell& cell) const {
        if (!body_.has_inside) {
            return {};
        }
        auto all = std::make_shared<PointsAndEdges>(distinct(cell.faces));
        return [this, all](const Plane& plane, std::vector<Vec3>& points) {
            for (const auto& [i, k] : all->edges) {
                const Vec3 &a = all->points[i], &b = all->points[k];
                const double ha = plane.height(a), hb = plane.height(b);
                if ((ha < 0) != (hb < 0)) {
                    if (const Vec3 p = a + (b - a) * (ha / (ha - hb)); body_.inside(p)) {
                        points.push_back(p);
                    }
                }
            }
        };
    }
    std::array<SpaceCell, 2> halves(const SpaceCell& cell) const {
        check_cancelled();
        const Brick seen = seen_of(cell);
        const PairPrice sum = volume_of_hulls;
        CutSearch search({&seen}, sum, corners_in_plane(cell));
        const std::vector<Plane> planes = candidates(seen.points);
        Cut best{planes.front()};
        for (const Plane& plane : planes) {
            if (const Cut cut = search.at(plane, best.price); cut.price < best.price) {
                best = cut;
            }
        }
        constexpr int tries = 6;
        return parts(cell, search.improved(best, tries).plane);
    }
    /// Returns one point in each part of the bounding box that has any: the least by its coordinates. O(n).
    static std::vector<Vec3> spread(const std::vector<Vec3>& points) {
        constexpr std::size_t parts = 24; // along the longest extent
        constexpr std::uint32_t none = UINT32_MAX;
        Box box;
        for (const Vec3& p : points) {
            box.add(p);
        }
        const double width = std::max({box.size().x, box.size().y, box.size().z, 1e-9}) / parts;
        const auto key = [&](std::uint32_t i) { return std::tie(points[i].x, points[i].y, points[i].z); };
        constexpr std::size_t places = parts + 1; // the farthest point is at the end of the last part
        std::vector<std::uint32_t> least(places * places * places, none);
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const Vec3 at = (points[i] - box.low) / width;
            std::uint32_t& known =
                least[(static_cast<std::size_t>(at.x) * places + static_cast<std::size_t>(at.y)) * places +
                      static_cast<std::size_t>(at.z)];
            if (known == none || key(i) < key(known)) {
                known = i;
            }
        }
        std::vector<Vec3> result;
        for (const std::uint32_t i : least) {
            if (i != none) {
                result.push_back(points[i]);
            }
        }
        return result;
    }
    /// Returns the points and edges of a cell's part of the body; of many points, some.
    static Brick seen_of(const SpaceCell& cell) {
        constexpr std::size_t enough = 2000, corners_a_point = 12; // mostly 6
        Brick brick;
        if (cell.surface.corners.size() <= enough * corners_a_point) {
            PointsAndEdges seen = distinct(cell.surface);
            brick.points = std::move(seen.points);
            brick.edges = std::move(seen.edges);
        }
        if (brick.points.empty() || brick.points.size() > enough) {
            brick.points = spread(cell.surface.corners);
            brick.edges.clear();
        }
        const auto first = static_cast<std::uint32_t>(brick.points.size());
        brick.points.insert(brick.points.end(), cell.corners.points.begin(), cell.corners.points.end());
        for (const auto& [a, b] : cell.corners.edges) {
            brick.edges.push_back({first + a, first + b});
        }
        for (const Vec3& p : brick.points) {
            brick.box.add(p);
        }
        return brick;
    }
    std::array<SpaceCell, 2> parts(const SpaceCell& cell, const Plane& plane) const {
        std::array<SpaceCell, 2> two;
        std::vector<Vec3> rim;
        cut(cell.surface, plane, two[0].surface, two[1].surface, &rim);
        if (body_.volumes_by_surface) {
            cut(cell.caps, plane, two[0].caps, two[1].caps, &rim);
            for (std::size_t i = 0; i + 1 < rim.size(); i += 2) {
                for (const Vec3& p : {rim.front(), rim[i + 1], rim[i]}) {
                    two[0].caps.corners.push_back(p);
                }
                for (const Vec3& p : {rim.front(), rim[i], rim[i + 1]}) {
                    two[1].caps.corners.push_back(p);
                }
                two[0].caps.close();
                two[1].caps.close();
            }
        }
        for (const Vec3& p : cell.samples) {
            two[plane.height(p) > 0 ? 1 : 0].samples.push_back(p);
        }
        std::vector<Vec3> edge;
        cut(cell.faces, plane, two[0].faces, two[1].faces, &edge);
        std::vector<Vec3> corners;
        for (std::size_t i = 0; i + 1 < edge.size(); i += 2) {
            corners.push_back(edge[i]);
        }
        append_face(corners, plane, true, two[0].faces);
        append_face(corners, plane, false, two[1].faces);
        for (SpaceCell& part : two) {
            judge(part, cell);
        }
        if (two[0].surface.ends.empty()) {
            std::swap(two[0], two[1]);
        }
        return two;
    }
    Brick brick_of(const SpaceCell& cell) const {
        check_cancelled();
        HullOfPoints hull;
        std::vector<Vec3> points = cell.surface.corners;
        points.insert(points.end(), cell.corners.points.begin(), cell.corners.points.end());
        Brick brick = brick_around(hull, std::move(points), cell.surface);
        if (body_.is_filled) {
            brick.regions.push_back(region_around(hull, distinct(cell.faces).points));
        }
        return brick;
    }

    const Body& body_;
    const std::size_t most_;
    std::vector<SpaceCell> cells_;
};

} // namespace

std::vector<Brick> bricks_of(const Body& body, std::size_t most) {
    return Cutting(body, most).run();
}

} // namespace foam::inline search::convex
