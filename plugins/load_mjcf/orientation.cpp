// As MuJoCo's compiler does it (src/user/user_objects.cc: ResolveOrientation).
#include "orientation.hpp"

#include <fmt/format.h>

#include <numbers>

namespace foam::mjcf {
namespace {

constexpr double least_length = 1e-14; // mjEPS

/// Returns the unit vector. Fails on one that has no direction.
Vec3 direction(const Attributes& attributes, std::string_view key, const Vec3& v) {
    if (norm(v) < least_length) {
        attributes.fail(key, "the vector has no direction; remedy: one that is not 0");
    }
    return normalized(v);
}

Pose of_xyaxes(const Attributes& attributes, const std::vector<double>& v) {
    const Vec3 x = direction(attributes, "xyaxes", {v[0], v[1], v[2]}), stated{v[3], v[4], v[5]};
    const Vec3 y = direction(attributes, "xyaxes", stated - x * dot(x, stated)), z = cross(x, y);
    Pose pose;
    pose.rotation = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
    return pose;
}

Pose rotation_of(const Attributes& attributes, const Settings& settings) {
    const double unit = settings.degrees ? std::numbers::pi / 180 : 1;
    if (const auto v = attributes.numbers("axisangle", 4, 4); !v.empty()) {
        return Pose::from_axis_angle(direction(attributes, "axisangle", {v[0], v[1], v[2]}), v[3] * unit);
    }
    if (const auto v = attributes.numbers("xyaxes", 6, 6); !v.empty()) {
        return of_xyaxes(attributes, v);
    }
    if (const auto v = attributes.vector("zaxis")) {
        return turned_z(direction(attributes, "zaxis", *v));
    }
    if (const auto v = attributes.numbers("euler", 3, 3); !v.empty()) {
        return of_euler(v, settings);
    }
    const auto v = attributes.numbers("quat", 4, 4);
    return v.empty() || (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0)
               ? Pose{}
               : from_quaternion({}, {v[0], v[1], v[2], v[3]});
}

} // namespace

Pose pose_of(const Attributes& attributes, const Settings& settings) {
    Pose pose = rotation_of(attributes, settings);
    pose.translation = attributes.vector("pos").value_or(Vec3{});
    return pose;
}

Pose of_euler(std::span<const double> angles, const Settings& settings) {
    const double unit = settings.degrees ? std::numbers::pi / 180 : 1;
    Pose pose;
    for (std::size_t i = 0; i < 3; ++i) {
        const char letter = settings.eulerseq[i];
        const bool moves_along = letter >= 'a'; // small letters: the axes turn along
        const int axis = letter - (moves_along ? 'x' : 'X');
        Vec3 along;
        along[axis] = 1;
        const Pose turn = Pose::from_axis_angle(along, angles[i] * unit);
        pose = moves_along ? pose * turn : turn * pose;
    }
    return pose;
}

Pose turned_z(const Vec3& direction) {
    const Vec3 to = normalized(direction), axis = cross(Vec3{0, 0, 1}, to);
    const double sine = norm(axis);
    if (sine < 1e-10) {
        return to.z < 0 ? Pose::from_axis_angle({1, 0, 0}, std::numbers::pi) : Pose{};
    }
    return Pose::from_axis_angle(axis / sine, std::atan2(sine, to.z));
}

} // namespace foam::mjcf
