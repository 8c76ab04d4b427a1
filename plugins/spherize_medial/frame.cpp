#include "columns.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/parameter.hpp>

#include <Eigen/Eigenvalues>

namespace foam::medial {
namespace {

Eigen::Vector3d vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Returns the second moments of the surface about its centroid, in units of `scale`²; of the vertices if there is no
/// area.
Eigen::Matrix3d second_moments(const Mesh& surface, const Vec3& origin, double scale) {
    const auto unit = [&](std::uint32_t i) { return vector((surface.vertices[i] - origin) / scale); };
    double total = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const auto& [i, j, k] : surface.triangles) {
        const Eigen::Vector3d a = unit(i), b = unit(j), c = unit(k), sum = a + b + c;
        const double area = (b - a).cross(c - a).norm();
        total += area;
        mean += area * sum / 3;
        // ∫ x xᵀ over a triangle (Gottschalk 1996, eq. 3.20).
        moments += area / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    if (!(total > 0)) {
        for (const Vec3& v : surface.vertices) {
            const Eigen::Vector3d a = vector((v - origin) / scale);
            total += 1;
            mean += a;
            moments += a * a.transpose();
        }
    }
    mean /= total;
    return moments / total - mean * mean.transpose();
}

} // namespace

Vec3 Frame::to_local(const Vec3& p) const {
    const Vec3 d = (p - origin) / scale;
    return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)};
}

Vec3 Frame::to_world(const Vec3& p) const {
    return origin + direction_to_world(p) * scale;
}

Sphere Frame::sphere_to_world(const Sphere& sphere) const {
    const Vec3 center = to_world(sphere.center);
    const double magnitude = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    return {center, sphere.radius * scale * (1 + 1e-12) + 4e-16 * (magnitude + scale)};
}

Frame principal_frame(const Mesh& surface) {
    const Box box = foam::bounds(surface);
    const Vec3 size = box.size();
    Frame frame{box.center(), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, std::max({size.x, size.y, size.z})};
    if (!(frame.scale > 1e-90 && frame.scale < 1e90)) {
        throw Error(ErrorCode::geometry, "the largest extent of the surface is " +
                                             to_text(ParameterValue(frame.scale)) +
                                             " m; nothing can be computed at that size: check the scale of the input");
    }
    Eigen::Matrix3d moments = second_moments(surface, frame.origin, frame.scale);
    // Products of inertia that are rounding errors must not turn the axes of an aligned part.
    const double noise = 1e-9 * moments.trace();
    moments = (moments.array().abs() < noise).select(0, moments);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
    for (int i = 0; i < 3; ++i) {
        Eigen::Vector3d axis = solver.eigenvectors().col(2 - i);
        Eigen::Index largest = 0;
        axis.cwiseAbs().maxCoeff(&largest);
        axis *= axis[largest] < 0 ? -1 : 1;
        frame.axes[static_cast<std::size_t>(i)] = {axis[0], axis[1], axis[2]};
    }
    Box local;
    for (const Vec3& v : surface.vertices) {
        local.add(frame.to_local(v));
    }
    const Vec3 extent = local.size();
    frame.origin = frame.to_world(local.center());
    frame.scale *= std::max({extent.x, extent.y, extent.z});
    return frame;
}

} // namespace foam::medial
