// The search for the radius for a number of spheres.
#pragma once

#include <foam/geometry/cell.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <vector>

namespace foam::spherize_voxel {

/// The voxels of a solid at any radius. The lattice is centred in the solid's box.
class Lattice {
public:
    /// Prepares the lattice. `spacing`: edge of a voxel in radii of the sphere about its centre. Up to 2/√3 the sphere
    /// contains its voxel.
    Lattice(const Solid& solid, const std::array<Vec3, 3>& axes, Cell::Content content, double spacing);

    /// Returns the solid in one cell.
    const Cell& whole() const { return whole_; }
    /// Returns the largest radius at which the box has more than one voxel.
    double largest_radius() const;
    /// Returns the number of voxels of the box, filled or not, without looking at the solid.
    double voxels_of_box(double radius) const;
    /// Returns the voxels that are not empty. Precondition: voxels_of_box(radius) fits into memory.
    std::vector<Cell> filled(double radius) const;
    /// Returns a sphere about the centre of each voxel, in the solid's frame; about the whole solid if that is one
    /// voxel.
    std::vector<Sphere> spheres(const std::vector<Cell>& voxels, double radius) const;

private:
    std::array<double, 3> counts(double radius) const;

    Cell whole_;
    Vec3 middle_; ///< of the solid's bounds, the origin of its cells' boxes
    double spacing_;
};

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
