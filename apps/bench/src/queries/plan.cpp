#include "plan.hpp"

#include <fmt/format.h>

namespace foam::inline bench {

QueryPlan::QueryPlan(const TwoModels& models, const EnvironmentRule& rule, const QueryCounts& counts,
                     std::uint64_t seed)
    : models_(models), counts_(counts), seed_(seed) {
    const std::vector<Box> bounds = body_bounds(models.original);
    Random random(derive_seed(seed, "reach"));
    const Box region = reach(*models.kinematics, models.links, bounds, random);
    const std::vector<Box> kept_free = immovable(*models.kinematics, models.links, bounds);
    for (std::size_t e = 0; e < counts.environments; ++e) {
        Random own(derive_seed(seed, fmt::format("environment {}", e)));
        environments_.push_back(random_environment(rule, region, kept_free, own));
    }
}

std::vector<EngineQuery> QueryPlan::queries(std::size_t first, std::size_t count, std::size_t distances) const {
    std::vector<EngineQuery> result;
    const Kinematics& kinematics = *models_.kinematics;
    for (std::size_t i = first; i < first + count; ++i) {
        EngineQuery& query = result.emplace_back();
        query.environment = static_cast<std::uint32_t>(i * counts_.environments / counts_.queries);
        query.distance = i * distances % counts_.queries < distances;
        Random random(derive_seed(seed_, fmt::format("configuration {}", i)));
        const std::vector<Pose> poses = kinematics.link_poses(kinematics.random_configuration(random));
        for (const std::size_t link : models_.links) {
            query.poses.push_back(poses[link]);
        }
    }
    return result;
}

} // namespace foam::bench
