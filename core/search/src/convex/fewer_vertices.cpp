#include "collapsing_hull.hpp"

#include "cloud.hpp"

#include <foam/geometry/internal/quickhull.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <numbers>

namespace foam::inline search::convex {
namespace {

/// Returns the corners of a cube about the origin, or of a tetrahedron around it where a cube has too many.
std::vector<Vec3> around_cube(double half, std::size_t most) {
    if (most < 8) {
        const Vec3 corner{-half, -half, -half}; // the plane through the other three has the opposite corner of the cube
        return {corner, corner + Vec3{6 * half, 0, 0}, corner + Vec3{0, 6 * half, 0}, corner + Vec3{0, 0, 6 * half}};
    }
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
    }
    return corners;
}

/// Returns far fewer points whose hull contains those given, which are many, and is larger by a thousandth at most: the
/// vertices of a coarse hull, moved away from its middle. Returns the given ones if that leaves most of them.
std::vector<Vec3> thinned(std::vector<Vec3> points) {
    constexpr double coarsest = 2e-3, finest = 1e-6, finer = 0.25, most_growth = 1e-3, rounding = 1e-9;
    const geometry::FarthestPoint farthest(points);
    HullOfPoints hull;
    for (double tolerance = coarsest; tolerance > finest; tolerance *= finer) {
        hull.run(points, tolerance);
        const std::vector<std::uint32_t> vertices = hull.vertices();
        if (hull.triangles().empty() || 2 * vertices.size() > points.size()) {
            continue;
        }
        Vec3 middle{};
        for (const std::uint32_t v : vertices) {
            middle += points[v] / static_cast<double>(vertices.size());
        }
        double growth = 0; // so that every plane is beyond all points
        for (const geometry::HullTriangle& t : hull.triangles()) {
            const double above = farthest.above(t.normal, t.at, 0), height = dot(t.normal, t.at - middle);
            growth = std::max(growth, above > 0 ? above / std::max(height, rounding) : 0);
        }
        if (growth <= most_growth) {
            std::vector<Vec3> result;
            for (const std::uint32_t v : vertices) {
                result.push_back(middle + (points[v] - middle) * (1 + growth + rounding));
            }
            return result;
        }
    }
    return points;
}

/// A frame in which points are as long as wide and high, and the diagonal of their box is 1. Hulls and shares of
/// volumes are the same in it, so needles and plates are as good as balls.
class RoundFrame {
public:
    explicit RoundFrame(std::span<const Vec3> points) {
        Vec3 middle{};
        for (const Vec3& p : points) {
            middle += p / static_cast<double>(points.size());
        }
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (const Vec3& p : points) {
            const Eigen::Vector3d d(p.x - middle.x, p.y - middle.y, p.z - middle.z);
            spread += d * d.transpose();
        }
        const Eigen::Matrix3d axes =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(spread).eigenvectors();
        for (int k = 0; k < 3; ++k) {
            axes_[static_cast<std::size_t>(k)] = {axes(0, k), axes(1, k), axes(2, k)};
        }
        set_box(points);
    }
    Vec3 from(const Vec3& p) const {
        const Vec3 d = p - origin_;
        return {dot(axes_[0], d) / sizes_.x, dot(axes_[1], d) / sizes_.y, dot(axes_[2], d) / sizes_.z};
    }
    Vec3 to(const Vec3& q) const {
        return origin_ + axes_[0] * (q.x * sizes_.x) + axes_[1] * (q.y * sizes_.y) + axes_[2] * (q.z * sizes_.z);
    }

private:
    void set_box(std::span<const Vec3> points) {
        Box box;
        for (const Vec3& p : points) {
            box.add(Vec3{dot(axes_[0], p), dot(axes_[1], p), dot(axes_[2], p)});
        }
        const Vec3 middle = box.center();
        origin_ = axes_[0] * middle.x + axes_[1] * middle.y + axes_[2] * middle.z;
        const Vec3 size = box.size();
        const double least = 1e-12 * box.diagonal();
        sizes_ = Vec3{std::max(size.x, least), std::max(size.y, least), std::max(size.z, least)} * std::numbers::sqrt3;
    }

    Vec3 origin_{}, sizes_{};
    std::array<Vec3, 3> axes_{};
};

} // namespace

std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most) {
    const RoundFrame frame(polytope.surface.vertices);
    std::vector<Vec3> points;
    for (const Vec3& p : polytope.surface.vertices) {
        points.push_back(frame.from(p));
    }
    constexpr std::size_t many = 2000;
    if (points.size() > std::max(many, 8 * most)) {
        points = thinned(std::move(points));
    }
    HullOfPoints hull;
    hull.run(points);
    CollapsingHull collapsing(points, hull.triangles());
    if (hull.triangles().empty() || !collapsing.reduce_to(most)) {
        points = around_cube(0.5 / std::numbers::sqrt3, most);
    } else {
        points = collapsing.vertices();
    }
    for (Vec3& p : points) {
        p = frame.to(p);
    }
    return convex_hull(points);
}

} // namespace foam::inline search::convex
