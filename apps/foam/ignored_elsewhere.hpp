// A self-collision matrix held against the pairs that a file of others leaves out.
#pragma once

#include <foam/collision/self_collision.hpp>
#include <foam/judge/collision_model.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace foam::cli {

struct Agreement {
    std::string file;
    std::size_t both = 0;             ///< left out here and there
    std::vector<IgnoredPair> unknown; ///< of links that have no spheres, or that the robot lacks
    struct Difference {
        LinkPair pair;
        std::string reason; ///< there
    };
    std::vector<Difference> only_there; ///< to check here
    std::vector<LinkPair> only_here;
};

Agreement agreement(const std::string& file, const Robot& robot, const SelfCollisionMatrix& matrix);
std::string text_of(const Agreement& agreement, const Robot& robot, const SelfCollisionMatrix& matrix);
nlohmann::ordered_json json_of(const Agreement& agreement, const Robot& robot);

/// What is known of a pair, in words.
std::string evidence(const SelfCollisionMatrix& matrix, const LinkPair& pair);

} // namespace foam::cli
