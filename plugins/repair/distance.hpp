// How far a surface ended from the one it stands for.
#pragma once

#include <foam/mesh.hpp>

#include <cstdint>

namespace foam::watertight {

struct Distances {
    double max = 0, mean = 0;
};

/// From points of `from` (uniform by area) to the nearest point of `to`. Sampled: the maximum is a lower bound.
Distances sampled_distance(const Mesh& from, const Mesh& to, std::uint64_t seed);

} // namespace foam::watertight
