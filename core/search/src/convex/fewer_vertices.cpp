#include "fewer_vertices.hpp"

#include "hull_of_points.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace foam::inline search::convex {
namespace {

struct HalfSpace {
    Vec3 normal;
    double offset;
    double area; ///< of the triangle
};

struct Collapse {
    std::uint32_t a, b;
    Vec3 to;
    double added; ///< volume
};

/// Finds the point on or beyond all planes for which the sum of area · height is least: a corner of three planes.
class Outermost {
public:
    explicit Outermost(const std::vector<HalfSpace>& planes)
        : planes_(planes), crosses_(planes.size() * planes.size()) {
        for (std::size_t i = 0; i < planes.size(); ++i) {
            weight_ += planes[i].area;
            slope_ += planes[i].normal * planes[i].area;
            level_ += planes[i].area * planes[i].offset;
            for (std::size_t k = i + 1; k < planes.size(); ++k) {
                crosses_[i * planes.size() + k] = cross(planes[i].normal, planes[k].normal);
            }
        }
    }

    /// Nothing if there is none within reach.
    std::optional<Vec3> find() {
        const std::size_t n = planes_.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 1; j < n; ++j) {
                const Vec3& along = crosses_[i * n + j];
                for (std::size_t k = j + 1; k < n; ++k) {
                    const double det = dot(along, planes_[k].normal);
                    if (std::abs(det) < 1e-4) {
                        continue;
                    }
                    look_at(crosses_[j * n + k] * planes_[i].offset - crosses_[i * n + k] * planes_[j].offset +
                                along * planes_[k].offset,
                            det);
                }
            }
        }
        return best_;
    }

private:
    static constexpr double inside = 1e-9; // units, much more than rounding

    /// Looks at the point `times_det` / `det`.
    void look_at(const Vec3& times_det, double det) {
        // Most points are inside of the plane that another one was inside of, or add too much. That needs no division.
        const double size = std::abs(det), sign = det < 0 ? -1 : 1;
        const HalfSpace& last = planes_[last_];
        if (sign * dot(last.normal, times_det) < (last.offset - 2 * inside) * size ||
            sign * dot(slope_, times_det) > (3 * least_ + 2 * inside * weight_ + level_) * size) {
            return;
        }
        const Vec3 p = times_det / det;
        double added = 0;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const double height = dot(planes_[i].normal, p) - planes_[i].offset;
            if (height < -inside) {
                last_ = i;
                return;
            }
            added += planes_[i].area * height / 3;
        }
        if (added < least_) {
            least_ = added;
            best_ = p;
        }
    }

    const std::vector<HalfSpace>& planes_;
    std::vector<Vec3> crosses_; ///< of the normals of planes i < k, at i · count + k
    double weight_ = 0, level_ = 0;
    Vec3 slope_{};         ///< of the sum of area · height
    std::size_t last_ = 0; ///< the plane that a point was inside of
    double least_ = std::numeric_limits<double>::infinity();
    std::optional<Vec3> best_;
};

/// Lists the triangles at each point of a hull.
class Fans {
public:
    Fans(const std::vector<Vec3>& points, const std::vector<geometry::HullTriangle>& triangles)
        : points_(points), triangles_(triangles), at_(points.size()) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const auto& [p, q, r] = triangles[i].corners;
            areas_.push_back(norm(cross(points[q] - points[p], points[r] - points[p])) / 2);
            for (const std::uint32_t c : triangles[i].corners) {
                at_[c].push_back(i);
            }
        }
    }
    /// Returns the collapse of an edge.
    std::optional<Collapse> of(std::uint32_t a, std::uint32_t b) const {
        std::vector<std::uint32_t> around = at_[a];
        around.insert(around.end(), at_[b].begin(), at_[b].end());
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        std::vector<HalfSpace> planes;
        for (const std::uint32_t i : around) {
            const geometry::HullTriangle& t = triangles_[i];
            const double offset = dot(t.normal, t.at);
            const auto same = std::find_if(planes.begin(), planes.end(), [&](const HalfSpace& h) {
                return dot(h.normal, t.normal) > 1 - 1e-10 && std::abs(h.offset - offset) < 1e-9;
            });
            if (same != planes.end()) {
                same->area += areas_[i];
            } else if (t.normal != Vec3{}) {
                planes.push_back({t.normal, offset, areas_[i]});
            }
        }
        constexpr std::size_t most_planes = 24; // more are at the tips of cones, whose edges others serve as well
        if (planes.size() > most_planes) {
            return std::nullopt;
        }
        const std::optional<Vec3> to = Outermost(planes).find();
        return to ? std::optional(Collapse{a, b, *to, added_by(*to)}) : std::nullopt;
    }
    /// Calls visit(point) for the points of the triangles at a point.
    template <class Visit> void for_each_near(std::uint32_t a, Visit visit) const {
        for (const std::uint32_t i : at_[a]) {
            for (const std::uint32_t c : triangles_[i].corners) {
                visit(c);
            }
        }
    }

private:
    /// Returns the volume that a point adds to the hull: it may be beyond more triangles than those it stands for.
    double added_by(const Vec3& p) const {
        double sum = 0;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (const double height = geometry::distance(triangles_[i], p); height > 0) {
                sum += areas_[i] * height / 3;
            }
        }
        return sum;
    }

    const std::vector<Vec3>& points_;
    const std::vector<geometry::HullTriangle>& triangles_;
    std::vector<double> areas_;
    std::vector<std::vector<std::uint32_t>> at_;
};

/// Collapses edges that have no triangle in common, those that add least first, a part of what is needed. Returns false
/// if none can be collapsed.
bool collapse_some(HullOfPoints& hull, std::vector<Vec3>& points, std::size_t needed) {
    const Fans fans(points, hull.triangles());
    std::vector<Collapse> collapses;
    for (const auto& [a, b] : hull.edges()) {
        if (const auto collapse = fans.of(a, b)) {
            collapses.push_back(*collapse);
        }
    }
    std::stable_sort(collapses.begin(), collapses.end(),
                     [](const Collapse& a, const Collapse& b) { return a.added < b.added; });
    std::vector<char> touched(points.size(), 0), gone(points.size(), 0);
    const std::size_t share = 2 * needed > points.size() ? 3 : 8; // with care towards the end
    const std::size_t most = std::max<std::size_t>(1, needed / share);
    std::size_t done = 0;
    std::vector<Vec3> next;
    for (const Collapse& collapse : collapses) {
        if (done == most) {
            break;
        }
        if (touched[collapse.a] || touched[collapse.b]) {
            continue;
        }
        for (const std::uint32_t end : {collapse.a, collapse.b}) {
            fans.for_each_near(end, [&](std::uint32_t p) { touched[p] = 1; });
            gone[end] = 1;
        }
        next.push_back(collapse.to);
        ++done;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!gone[i]) {
            next.push_back(points[i]);
        }
    }
    points = std::move(next);
    return done > 0;
}

/// Returns the corners of a box about the origin, or of a tetrahedron around it where a box has too many.
std::vector<Vec3> around_box(const Vec3& half, std::size_t most) {
    if (most < 8) {
        const Vec3 corner = -half; // the plane through the other three has the opposite corner of the box
        return {corner, corner + Vec3{6 * half.x, 0, 0}, corner + Vec3{0, 6 * half.y, 0},
                corner + Vec3{0, 0, 6 * half.z}};
    }
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
    }
    return corners;
}

} // namespace

std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most) {
    const std::vector<Vec3>& given = polytope.surface.vertices;
    Box box;
    for (const Vec3& p : given) {
        box.add(p);
    }
    const Vec3 origin = box.center();
    const double unit = box.diagonal();
    std::vector<Vec3> points;
    for (const Vec3& p : given) {
        points.push_back((p - origin) / unit);
    }
    HullOfPoints hull;
    while (true) {
        check_cancelled();
        hull.run(points);
        std::vector<Vec3> vertices;
        for (const std::uint32_t i : hull.vertices()) {
            vertices.push_back(points[i]);
        }
        points = std::move(vertices);
        if (points.size() <= most) {
            break;
        }
        hull.run(points); // indices of the vertices alone
        if (!collapse_some(hull, points, points.size() - most)) {
            break;
        }
    }
    if (points.size() > most) {
        points = around_box(box.size() * (0.5 / unit), most);
    }
    for (Vec3& p : points) {
        p = origin + p * unit;
    }
    return convex_hull(points);
}

} // namespace foam::inline search::convex
