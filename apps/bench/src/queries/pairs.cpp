#include "pairs.hpp"

#include <foam/collision/self_collision.hpp>

#include <map>

namespace foam::inline bench {
namespace {

CollisionModel collision_model(const TwoModels& models) {
    CollisionModel result;
    result.robot = std::shared_ptr<const Robot>(models.kinematics, &models.kinematics->robot());
    result.elements.resize(result.robot->links.size());
    result.sources.resize(result.robot->links.size(), CollisionModel::Source::none);
    for (std::size_t b = 0; b < models.links.size(); ++b) {
        for (const EngineShape& shape : models.spheres.bodies[b]) {
            result.elements[models.links[b]].add(
                Sphere{shape.pose.translation, std::get<Element>(shape.geometry).radius});
        }
        result.sources[models.links[b]] = CollisionModel::Source::given;
    }
    return result;
}

} // namespace

std::vector<std::array<std::uint32_t, 2>> tested_pairs(const TwoModels& models, std::uint64_t seed) {
    SelfCollisionOptions options;
    options.samples = 10000;
    options.seed = seed;
    options.proof_boxes = 0; // samples are enough to choose what to measure
    const SelfCollisionMatrix matrix = self_collision_matrix(*models.kinematics, collision_model(models), options);
    std::map<std::size_t, std::uint32_t> body_of;
    for (std::size_t b = 0; b < models.links.size(); ++b) {
        body_of[models.links[b]] = static_cast<std::uint32_t>(b);
    }
    std::vector<std::array<std::uint32_t, 2>> result;
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.reason == PairReason::none && 2 * pair.touching <= pair.samples) {
            const auto [low, high] = std::minmax(body_of.at(pair.first), body_of.at(pair.second));
            result.push_back({low, high});
        }
    }
    return result;
}

} // namespace foam::inline bench
