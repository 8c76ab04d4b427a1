// The convex hull as a polytope: triangles of one plane become one face, and the offsets of faces contain all points.
#include <foam/geometry/internal/quickhull.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/element.hpp>

#include <algorithm>
#include <numeric>

namespace foam::inline geometry {
namespace {

constexpr std::uint32_t no_index = 0xFFFFFFFFu;

double largest_coordinate(std::span<const Vec3> points) {
    double most = 0;
    for (const Vec3& p : points) {
        if (!is_finite(p)) {
            throw Error(ErrorCode::geometry, "a convex hull needs points with finite coordinates");
        }
        most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return most;
}

/// Points scaled by a power of two, so that products of three differences neither overflow nor underflow. Coordinates
/// below 2^-250 of the largest become 0.
std::vector<Vec3> scaled(std::span<const Vec3> points, double most) {
    const int exponent = most > 0 ? -std::ilogb(most) : 0;
    const auto one = [&](double x) {
        const double y = std::ldexp(x, exponent);
        return std::abs(y) < 0x1p-250 ? 0 : y;
    };
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Vec3& p : points) {
        result.push_back({one(p.x), one(p.y), one(p.z)});
    }
    return result;
}

/// The triangles of a hull by the planes that they lie in.
class Facets {
public:
    Facets(std::span<const Vec3> points, const std::vector<HullTriangle>& triangles, double tolerance)
        : points_(points), triangles_(triangles), tolerance_(tolerance), of_(triangles.size(), no_index) {}

    struct Facet {
        std::uint32_t seed;                 ///< its largest triangle, which gives the plane
        std::vector<std::uint32_t> corners; ///< of the polygon, counter-clockwise seen from outside
    };

    /// Returns the facets, with triangles that lie in one plane, to within the tolerance, as one. Returns the triangles
    /// where rounding makes a polygon that is not simple.
    std::vector<Facet> run() {
        merge();
        if (facets_.size() >= 4 && find_polygons() && have_edges_once()) {
            return std::move(facets_);
        }
        facets_.clear();
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const auto& c = triangles_[i].corners;
            facets_.push_back({i, {c.begin(), c.end()}});
        }
        return std::move(facets_);
    }

private:
    double doubled_area(std::uint32_t i) const {
        const auto& [a, b, c] = triangles_[i].corners;
        return norm(cross(points_[b] - points_[a], points_[c] - points_[a]));
    }

    void merge() {
        std::vector<std::uint32_t> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::vector<double> area(triangles_.size());
        for (std::uint32_t i = 0; i < area.size(); ++i) {
            area[i] = doubled_area(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
        std::vector<std::uint32_t> open;
        for (const std::uint32_t seed : order) {
            if (of_[seed] != no_index) {
                continue;
            }
            of_[seed] = static_cast<std::uint32_t>(facets_.size());
            open.assign(1, seed);
            while (!open.empty()) {
                const std::uint32_t i = open.back();
                open.pop_back();
                for (const std::uint32_t k : triangles_[i].across) {
                    if (of_[k] == no_index && in_plane(triangles_[seed], triangles_[k])) {
                        of_[k] = of_[seed];
                        open.push_back(k);
                    }
                }
            }
            facets_.push_back({seed, {}});
        }
    }

    bool in_plane(const HullTriangle& plane, const HullTriangle& t) const {
        const bool sliver = t.error > tolerance_; // its normal may be anything
        return (sliver || dot(plane.normal, t.normal) > 0) &&
               std::all_of(t.corners.begin(), t.corners.end(),
                           [&](std::uint32_t c) { return std::abs(distance(plane, points_[c])) <= tolerance_; });
    }

    /// Follows the boundary of each facet. A corner stays where three facets or more meet; elsewhere it lies in a
    /// facet or on an edge, and so on that of both facets there. Returns false if a boundary passes a corner twice, or is
    /// more than one loop: then the way around ends early.
    bool find_polygons() {
        std::vector<std::uint32_t> next(points_.size(), no_index), meeting(points_.size(), 0);
        std::vector<std::vector<std::uint32_t>> members(facets_.size());
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            members[of_[i]].push_back(i);
            for (std::size_t k = 0; k < 3; ++k) {
                // each facet at a corner has one edge of its boundary that begins there
                meeting[triangles_[i].corners[k]] += of_[triangles_[i].across[k]] != of_[i];
            }
        }
        for (std::uint32_t f = 0; f < facets_.size(); ++f) {
            std::uint32_t start = no_index;
            std::size_t edges = 0;
            for (const std::uint32_t i : members[f]) {
                const HullTriangle& t = triangles_[i];
                for (std::size_t k = 0; k < 3; ++k) {
                    if (of_[t.across[k]] != f) {
                        start = t.corners[k];
                        next[start] = t.corners[(k + 1) % 3];
                        ++edges;
                    }
                }
            }
            std::uint32_t at = start;
            for (; edges > 0; --edges) {
                if (meeting[at] >= 3) {
                    facets_[f].corners.push_back(at);
                }
                const std::uint32_t to = next[at];
                next[at] = no_index;
                at = to;
                if (at == no_index) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Returns whether no edge is there twice: that of a facet with two corners is, since its neighbours have it, too. In
    /// the other direction each edge is that of the facet beyond it, which has the same corners.
    bool have_edges_once() const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const Facet& facet : facets_) {
            for (std::size_t k = 0; k < facet.corners.size(); ++k) {
                edges.push_back({facet.corners[k], facet.corners[(k + 1) % facet.corners.size()]});
            }
        }
        std::sort(edges.begin(), edges.end());
        return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
    }

    std::span<const Vec3> points_;
    const std::vector<HullTriangle>& triangles_;
    double tolerance_;
    std::vector<std::uint32_t> of_; ///< the facet of each triangle
    std::vector<Facet> facets_;
};

/// Returns offsets, in the scale of the points, so that all points are inside of all planes.
///
/// A point in the hull of the triangles is above a triangle's computed plane by no more than the error of its normal
/// times the size, HullTriangle::error. Where that is much, and where there are few corners, the farthest is looked
/// for. `near` points may be outside of the hull and count in any case.
std::vector<double> offsets(std::span<const Vec3> points, const std::vector<HullTriangle>& triangles,
                            std::span<const Facets::Facet> facets, std::span<const std::uint32_t> near, double size,
                            double tolerance) {
    std::vector<char> used(points.size(), 0);
    std::vector<Vec3> corners, outside;
    for (const HullTriangle& t : triangles) {
        for (const std::uint32_t c : t.corners) {
            if (!used[c]) {
                corners.push_back(points[c]);
            }
            used[c] = 1;
        }
    }
    for (const std::uint32_t p : near) {
        outside.push_back(points[p]);
    }
    constexpr std::size_t few = 200'000; // a fraction of a millisecond
    const bool look_at_all = corners.size() * facets.size() <= few;
    const FarthestPoint of_corners(std::move(corners)), of_outside(std::move(outside));
    std::vector<double> result;
    CancellationCounter asking(64);
    for (const Facets::Facet& facet : facets) {
        asking.check();
        const HullTriangle& plane = triangles[facet.seed];
        const bool look = look_at_all || plane.error > 16 * tolerance;
        double above = look ? of_corners.above(plane.normal, plane.at, 0) : plane.error;
        above = of_outside.above(plane.normal, plane.at, above);
        const double offset = dot(plane.normal, plane.at) + above;
        // Distances are off by 8 u of their size, the offset and a product with the normal by 4 u of theirs.
        const double reach = std::abs(plane.at.x) + std::abs(plane.at.y) + std::abs(plane.at.z);
        result.push_back(offset + 16 * unit_roundoff * (reach + size));
    }
    return result;
}

} // namespace

std::shared_ptr<const Polytope> convex_hull(std::span<const Vec3> points) {
    const double most = largest_coordinate(points);
    const std::vector<Vec3> at = scaled(points, most);
    Box box;
    for (const Vec3& p : at) {
        box.add(p);
    }
    const double size = box.diagonal() * 1.001;
    const double tolerance =
        16 * unit_roundoff * size + 4 * unit_roundoff * std::scalbn(most, most > 0 ? -std::ilogb(most) : 0);
    Quickhull hull(at, size, tolerance);
    if (!hull.run()) {
        throw Error(ErrorCode::geometry, "a convex hull needs four points that do not lie in a plane");
    }
    const std::vector<Facets::Facet> facets = Facets(at, hull.triangles(), tolerance).run();
    const std::vector<double> offset = offsets(at, hull.triangles(), facets, hull.near(), size, tolerance);
    auto result = std::make_shared<Polytope>();
    std::vector<std::uint32_t> name(points.size(), no_index);
    const auto vertex = [&](std::uint32_t point) {
        if (name[point] == no_index) {
            name[point] = static_cast<std::uint32_t>(result->surface.vertices.size());
            result->surface.vertices.push_back(points[point]);
        }
        return name[point];
    };
    const double unit = std::ldexp(1.0, std::ilogb(most)); // not all points are at 0
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::vector<std::uint32_t>& c = facets[f].corners;
        for (std::size_t k = 2; k < c.size(); ++k) {
            result->surface.triangles.push_back({vertex(c[0]), vertex(c[k - 1]), vertex(c[k])});
        }
        const Vec3& normal = hull.triangles()[facets[f].seed].normal;
        if (normal != Vec3{}) { // a triangle so thin that its corners, rounded, lie on a line has no plane
            result->faces.push_back(
                {normal, std::nextafter(offset[f] * unit, std::numeric_limits<double>::infinity())});
        }
    }
    return result;
}

} // namespace foam::geometry
