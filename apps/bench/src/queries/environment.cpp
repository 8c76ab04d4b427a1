#include "environment.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline bench {
namespace {

Box bounds_of(const EngineShape& shape) {
    Box box;
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry);
    const Mesh enclosing = mesh ? Mesh{} : enclosing_mesh(std::get<Element>(shape.geometry));
    for (const Vec3& v : mesh ? (*mesh)->vertices : enclosing.vertices) {
        box.add(shape.pose * v);
    }
    return box;
}

Box moved(const Box& box, const Pose& pose) {
    Box result;
    for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
        result.add(pose * Vec3{(corner & 1 ? box.high : box.low).x, (corner & 2 ? box.high : box.low).y,
                               (corner & 4 ? box.high : box.low).z});
    }
    return result;
}

/// Whether a joint between the root and the link moves.
bool moves(const Kinematics& kinematics, std::size_t link) {
    for (auto joint = kinematics.joint_above()[link]; joint;) {
        if (kinematics.motions()[*joint].freedom) {
            return true;
        }
        joint = kinematics.joint_above()[kinematics.link_above()[*joint]];
    }
    return false;
}

double distance_to(const Box& box, const Vec3& p) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double outside = std::max({box.low[axis] - p[axis], p[axis] - box.high[axis], 0.0});
        square += outside * outside;
    }
    return std::sqrt(square);
}

Element random_shape(bool box, const EnvironmentRule& rule, Random& random) {
    const auto edge = [&] { return random.uniform(rule.smallest, rule.largest); };
    if (!box) {
        return Element::sphere(edge() / 2);
    }
    const double x = edge(), y = edge();
    return Element::box({x, y, edge()});
}

} // namespace

/// Three uniform numbers to a unit quaternion (Shoemake, 1992).
Pose random_rotation(Random& random) {
    const double u = random.uniform(), a = random.uniform(0, 2 * std::numbers::pi),
                 b = random.uniform(0, 2 * std::numbers::pi);
    const double x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a), z = std::sqrt(u) * std::sin(b),
                 w = std::sqrt(u) * std::cos(b);
    const double sine = norm({x, y, z});
    return sine > 0 ? Pose::from_axis_angle(Vec3{x, y, z} / sine, 2 * std::atan2(sine, w)) : Pose{};
}

std::vector<Box> body_bounds(const EngineRobot& robot) {
    std::vector<Box> result;
    for (const EngineBody& body : robot.bodies) {
        Box& box = result.emplace_back();
        for (const EngineShape& shape : body) {
            box.add(bounds_of(shape));
        }
    }
    return result;
}

Box reach(const Kinematics& kinematics, const std::vector<std::size_t>& links, const std::vector<Box>& bounds,
          Random& random, std::size_t samples) {
    Box result;
    for (std::size_t s = 0; s < samples; ++s) {
        const std::vector<Pose> poses = kinematics.link_poses(kinematics.random_configuration(random));
        for (std::size_t b = 0; b < links.size(); ++b) {
            result.add(moved(bounds[b], poses[links[b]]));
        }
    }
    return result;
}

std::vector<Box> immovable(const Kinematics& kinematics, const std::vector<std::size_t>& links,
                           const std::vector<Box>& bounds) {
    const std::vector<Pose> poses = kinematics.link_poses(kinematics.configuration());
    std::vector<Box> result;
    for (std::size_t b = 0; b < links.size(); ++b) {
        if (!moves(kinematics, links[b])) {
            result.push_back(moved(bounds[b], poses[links[b]]));
        }
    }
    return result;
}

std::vector<Obstacle> random_environment(const EnvironmentRule& rule, const Box& region,
                                         const std::vector<Box>& kept_free, Random& random) {
    constexpr int most_draws = 10000;
    std::vector<Obstacle> result;
    for (int draw = 0; result.size() < rule.obstacles; ++draw) {
        if (draw == most_draws) {
            throw Error(ErrorCode::usage,
                        fmt::format("after {} draws only {} of {} obstacles are clear of the links that do not move; "
                                    "remedy: fewer or smaller obstacles",
                                    most_draws, result.size(), rule.obstacles));
        }
        Obstacle obstacle{random_rotation(random), random_shape(result.size() % 2 == 0, rule, random)};
        Vec3& center = obstacle.pose.translation;
        for (int axis = 0; axis < 3; ++axis) {
            center[axis] = random.uniform(region.low[axis], region.high[axis]);
        }
        const bool box = obstacle.shape.kind == Element::Kind::box;
        const double radius = box ? norm(obstacle.shape.half) : obstacle.shape.radius;
        if (std::all_of(kept_free.begin(), kept_free.end(),
                        [&](const Box& free) { return distance_to(free, center) > radius; })) {
            result.push_back(obstacle);
        }
    }
    return result;
}

} // namespace foam::bench
