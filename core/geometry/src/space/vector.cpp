#include <foam/geometry/vector.hpp>

namespace foam::inline geometry {

Pose Pose::operator*(const Pose& other) const {
    Pose result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                sum += rotation[static_cast<std::size_t>(row)][k] * other.rotation[static_cast<std::size_t>(k)][column];
            }
            result.rotation[static_cast<std::size_t>(row)][column] = sum;
        }
    }
    result.translation = *this * other.translation;
    return result;
}

Pose Pose::inverse() const {
    Pose result;
    const auto& r = rotation;
    result.rotation = {Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y}, Vec3{r[0].z, r[1].z, r[2].z}};
    result.translation = -result.rotate(translation);
    return result;
}

Pose Pose::from_xyz_rpy(const Vec3& xyz, const Vec3& rpy) {
    const double cr = std::cos(rpy.x), sr = std::sin(rpy.x);
    const double cp = std::cos(rpy.y), sp = std::sin(rpy.y);
    const double cy = std::cos(rpy.z), sy = std::sin(rpy.z);
    Pose pose;
    pose.rotation = {Vec3{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                     Vec3{sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr}, Vec3{-sp, cp * sr, cp * cr}};
    pose.translation = xyz;
    return pose;
}

Pose Pose::from_axis_angle(const Vec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
    const auto [x, y, z] = axis;
    Pose pose;
    pose.rotation = {Vec3{t * x * x + c, t * x * y - s * z, t * x * z + s * y},
                     Vec3{t * x * y + s * z, t * y * y + c, t * y * z - s * x},
                     Vec3{t * x * z - s * y, t * y * z + s * x, t * z * z + c}};
    return pose;
}

} // namespace foam::geometry
