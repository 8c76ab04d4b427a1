// Which links are tested against each other.
#pragma once

#include "robots.hpp"

namespace foam {

/// All pairs of bodies but those that are neighbours (no body between them) and those whose spheres touch in the zero
/// configuration or in all of many random ones: such a pair says nothing about a configuration. Since the spheres hold
/// the original, the original's pairs of that kind are among them.
std::vector<std::array<std::uint32_t, 2>> tested_pairs(const TwoModels& models, std::uint64_t seed);

} // namespace foam
