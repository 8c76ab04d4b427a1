// The radius for a number of spheres.
#pragma once

#include "lattice.hpp"

#include <foam/context.hpp>

#include <vector>

namespace foam::spherize_voxel {

/// The most voxels of a box, filled or not, that are worth looking at for so many spheres.
constexpr double most_voxels(std::size_t spheres) {
    return 1'000 + 50 * static_cast<double>(spheres);
}

/// Radii in even steps downwards from the one at which the solid is one voxel. For a number of spheres the radius is
/// the one whose spheres, no more than that, have the least volume together. As the radii are the same whatever number
/// is asked for, and more of them are looked at for a larger one, more spheres never claim more.
class RadiusSearch {
public:
    explicit RadiusSearch(const Lattice& lattice) : lattice_(lattice) {}

    struct Result {
        std::vector<Cell> voxels;
        std::vector<Sphere> spheres;
    };
    Result best(std::size_t most, Context& context);

private:
    /// What is known of a radius.
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
