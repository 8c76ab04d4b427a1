// Equal spheres on a cubic lattice.
#pragma once

#include <foam/geometry/cell.hpp>

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

} // namespace foam::spherize_voxel
