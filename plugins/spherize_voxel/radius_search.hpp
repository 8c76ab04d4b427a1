// The search for the radius for a number of spheres.
#pragma once

#include "lattice.hpp"

#include <foam/sdk/context.hpp>

#include <vector>

namespace foam::spherize_voxel {

/// Returns the most voxels of a box, filled or not, that are examined for so many spheres.
constexpr double most_voxels(std::size_t spheres) {
    return 1'000 + 50 * static_cast<double>(spheres);
}

/// Radii in even steps downwards from the one at which the solid is one voxel. For a number of spheres the result is
/// the radius whose spheres, at most that number, have the least union volume. The radii do not depend on the number,
/// and more of them are examined for a larger one, so more spheres never have more excess volume.
class RadiusSearch {
public:
    explicit RadiusSearch(const Lattice& lattice) : lattice_(lattice) {}

    struct Result {
        std::vector<Cell> voxels;
        std::vector<Sphere> spheres;
    };
    Result best(std::size_t most, Context& context);

private:
    /// The known figures of a radius.
    struct Rung {
        double radius = 0;      ///< m
        bool looked_at = false; ///< the figures below are known
        std::size_t count = 0;  ///< spheres
        double volume = -1;     ///< m³ of their union; negative: not known
    };
    Rung& rung(std::size_t index);
    void look_at(std::size_t first, std::size_t most, Context& context);

    const Lattice& lattice_;
    std::vector<Rung> rungs_;
};

} // namespace foam::spherize_voxel
