#include "pairs.hpp"

#include <algorithm>

namespace foam {
namespace {

struct Ball {
    Vec3 center;
    double radius;
};

std::vector<std::vector<Ball>> placed(const TwoModels& models, const std::vector<double>& configuration) {
    const std::vector<Pose> poses = models.kinematics->link_poses(configuration);
    std::vector<std::vector<Ball>> result;
    for (std::size_t b = 0; b < models.links.size(); ++b) {
        std::vector<Ball>& balls = result.emplace_back();
        for (const EngineShape& shape : models.spheres.bodies[b]) {
            balls.push_back(
                {poses[models.links[b]] * shape.pose.translation, std::get<Primitive>(shape.geometry).radius});
        }
    }
    return result;
}

bool touch(const std::vector<Ball>& a, const std::vector<Ball>& b) {
    return std::any_of(a.begin(), a.end(), [&](const Ball& p) {
        return std::any_of(b.begin(), b.end(),
                           [&](const Ball& q) { return distance(p.center, q.center) <= p.radius + q.radius; });
    });
}

/// The nearest body above each link; none: there is none.
std::optional<std::uint32_t> body_above(const TwoModels& models, std::size_t link) {
    const Kinematics& kinematics = *models.kinematics;
    for (auto joint = kinematics.joint_above()[link]; joint; joint = kinematics.joint_above()[link]) {
        link = kinematics.link_above()[*joint];
        const auto it = std::find(models.links.begin(), models.links.end(), link);
        if (it != models.links.end()) {
            return static_cast<std::uint32_t>(it - models.links.begin());
        }
    }
    return {};
}

} // namespace

std::vector<std::array<std::uint32_t, 2>> tested_pairs(const TwoModels& models, std::uint64_t seed) {
    constexpr std::size_t samples = 1000;
    std::vector<std::array<std::uint32_t, 2>> candidates, result;
    const auto zero = placed(models, models.kinematics->configuration());
    const auto count = static_cast<std::uint32_t>(models.links.size());
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            const bool neighbours =
                body_above(models, models.links[a]) == b || body_above(models, models.links[b]) == a;
            if (!neighbours && !touch(zero[a], zero[b])) {
                candidates.push_back({a, b});
            }
        }
    }
    std::vector<bool> apart(candidates.size(), false);
    Random random(derive_seed(seed, "pairs"));
    for (std::size_t s = 0; s < samples && std::find(apart.begin(), apart.end(), false) != apart.end(); ++s) {
        const auto bodies = placed(models, models.kinematics->random_configuration(random));
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            apart[c] = apart[c] || !touch(bodies[candidates[c][0]], bodies[candidates[c][1]]);
        }
    }
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        if (apart[c]) {
            result.push_back(candidates[c]);
        }
    }
    return result;
}

} // namespace foam
