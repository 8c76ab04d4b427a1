// Ellipsoids: the image of the unit ball, with half axes along the axes of the frame.
#include "convex/enclosing_mesh.hpp"
#include "convex/kind.hpp"

#include <foam/geometry/vector.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

/// The least half axis that is left of an eroded ellipsoid, m: its square does not lose much to underflow.
constexpr double least_axis = 1e-140;

/// Returns the point of the frame in which the ellipsoid is the unit ball.
Vec3 in_units(const Element& e, const Vec3& p) {
    return {p.x / e.half.x, p.y / e.half.y, p.z / e.half.z};
}

double least_of(const Vec3& v) {
    return std::min({v.x, v.y, v.z});
}

/// Returns the distance from the surface, of a point inside or outside. With the least half axis c, the nearest point is
/// aᵢ² pᵢ / (s + aᵢ² - c²) for the one s > 0 with which it lies on the surface. Newton's method for the reciprocal of
/// its distance from the centre in units is monotone from the left, and nearly exact after a few steps (Conn, Gould and
/// Toint: Trust-Region Methods, 2000, section 7.3.1).
double distance_from_surface(const Vec3& a, const Vec3& point) {
    const double c = least_of(a);
    Vec3 p{std::abs(point.x), std::abs(point.y), std::abs(point.z)};
    for (int axis = 0; axis < 3; ++axis) { // on the middle plane there are two nearest points
        p[axis] = a[axis] == c ? std::max(p[axis], 1e-16 * c) : p[axis];
    }
    const Vec3 beyond{a.x * a.x - c * c, a.y * a.y - c * c, a.z * a.z - c * c};
    double s = 0;
    for (int axis = 0; axis < 3; ++axis) {
        s = a[axis] == c ? std::max(s, c * p[axis]) : s;
    }
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps; ++step) {
        double squared = 0, slope = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double there = a[axis] * p[axis] / (s + beyond[axis]);
            squared += there * there;
            slope += there * there / (s + beyond[axis]);
        }
        const double length = std::sqrt(squared), move = (length - 1) * squared / slope;
        if (!(move > 1e-16 * s)) {
            break;
        }
        s += move;
    }
    Vec3 nearest;
    for (int axis = 0; axis < 3; ++axis) {
        nearest[axis] = a[axis] * a[axis] * p[axis] / (s + beyond[axis]);
    }
    return norm(p - nearest);
}

/// Returns an ellipsoid about the same centre that contains the ellipsoid and a point at `length` > 1 units from the
/// centre, with the least volume: longer along the point's direction in units, and as wide across it.
Element stretched(const Element& e, const Vec3& direction, double length) {
    const Vec3 u = normalized(direction);
    Eigen::Matrix3d image;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            image(row, column) = e.half[row] * ((row == column ? 1 : 0) + (length - 1) * u[row] * u[column]);
        }
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(image, Eigen::ComputeFullU);
    Eigen::Matrix3d axes = svd.matrixU();
    if (axes.determinant() < 0) {
        axes.col(2) *= -1;
    }
    const Eigen::Vector3d half = svd.singularValues(); // the largest first
    // What the axes are off by, at the far end of the longest, is a share of the shortest.
    const double room = 1 + 64 * std::numeric_limits<double>::epsilon() * half(0) / half(2);
    Element result = e;
    for (int row = 0; row < 3; ++row) {
        result.half[row] = half(row) * room;
        Vec3& turned = result.pose.rotation[static_cast<std::size_t>(row)];
        const Vec3& before = e.pose.rotation[static_cast<std::size_t>(row)];
        for (int column = 0; column < 3; ++column) {
            turned[column] = before.x * axes(0, column) + before.y * axes(1, column) + before.z * axes(2, column);
        }
    }
    return result;
}

class EllipsoidKind final : public ConvexKind {
public:
    using ConvexKind::ConvexKind;

    double signed_distance(const Element& e, const Vec3& p) const override {
        const double distance = distance_from_surface(e.half, p);
        return squared_norm(in_units(e, p)) <= 1 ? -distance : distance;
    }
    Vec3 support(const Element& e, const Vec3& d) const override {
        const Vec3 stretched{e.half.x * d.x, e.half.y * d.y, e.half.z * d.z};
        const double length = norm(stretched);
        return length > 0 ? Vec3{e.half.x * stretched.x, e.half.y * stretched.y, e.half.z * stretched.z} / length
                          : Vec3{0, 0, e.half.z};
    }
    Box bounds(const Element& e) const override {
        Vec3 reach;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& row = e.pose.rotation[static_cast<std::size_t>(axis)];
            reach[axis] = norm(Vec3{row.x * e.half.x, row.y * e.half.y, row.z * e.half.z});
        }
        return Box::about(e.pose.translation, reach);
    }
    double volume(const Element& e) const override { return 4.0 / 3 * pi * e.half.x * e.half.y * e.half.z; }
    std::optional<Vec3> second_moments(const Element& e) const override {
        return Vec3{e.half.x * e.half.x, e.half.y * e.half.y, e.half.z * e.half.z} * (volume(e) / 5);
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_ball(in_units(e, o), in_units(e, d), 1);
    }
    Mesh mesh(const Element& e, int segments) const override {
        return transformed(capsule_mesh(1, 0, segments), {}, e.half);
    }
    bool has_known_surface() const override { return true; }
    std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) const override {
        std::vector<ElementPoint> points;
        count = std::max<std::size_t>(count, 1);
        const double share = 4 * pi * e.half.x * e.half.y * e.half.z / static_cast<double>(count);
        for (const Vec3& n : fibonacci_directions(count)) {
            const Vec3 gradient = in_units(e, n); // its length times the volume is the area of the image
            points.push_back({{n.x * e.half.x, n.y * e.half.y, n.z * e.half.z}, normalized(gradient),
                              share * norm(gradient)});
        }
        for (int axis = 0; axis < 3; ++axis) { // the ends of the axes
            for (const double side : {-1.0, 1.0}) {
                Vec3 n{};
                n[axis] = side;
                points.push_back({n * e.half[axis], n, 0});
            }
        }
        return points;
    }
    /// A larger ellipsoid of the same form: by a factor f, its surface moves by at least (f - 1) times the least axis.
    Element grown(Element e, double length, double (*sum)(double, double)) const override {
        const double share = length / least_of(e.half);
        e.half = {sum(e.half.x, share * e.half.x), sum(e.half.y, share * e.half.y), sum(e.half.z, share * e.half.z)};
        return e;
    }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        Element result = e;
        for (const Vec3& p : points) {
            const Vec3 at = in_units(result, to_own_frame(result, p));
            const double length = norm(at) + room / least_of(result.half);
            if (length > 1) {
                result = norm(at) > 0 ? stretched(result, at, length) : foam::grown(result, room);
            }
        }
        return result;
    }
    /// By the same argument as grown().
    bool erode(Element& e, double length) const override {
        const double least = least_of(e.half), rest = (1 - length / least) * (1 - 1e-15);
        e.half *= rest;
        return length < least && least * rest >= least_axis;
    }
    bool holds_ball(const Element& e, const Vec3& p, double radius) const override {
        const double room = 1 - radius / least_of(e.half);
        return room > 0 && squared_norm(in_units(e, p)) <= room * room;
    }
};

constexpr std::array<std::string_view, 1> of_ellipsoid{"radii"};
constexpr EllipsoidKind ellipsoid("ellipsoid", of_ellipsoid);

} // namespace

extern constinit const ConvexKind* const ellipsoid_kind = &ellipsoid;

} // namespace foam::inline geometry
