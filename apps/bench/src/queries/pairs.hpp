// Which links are tested against each other.
#pragma once

#include "robots.hpp"

namespace foam::inline bench {

/// The pairs of bodies that self_collision_matrix() of the spheres says to check, but for those that touch in most
/// configurations, which say little about a configuration. Since the spheres hold the original, what never touches, or
/// is left out because it always does, is so for both models.
std::vector<std::array<std::uint32_t, 2>> tested_pairs(const TwoModels& models, std::uint64_t seed);

} // namespace foam::inline bench
