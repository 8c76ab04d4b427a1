#include "lattice.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>

namespace foam::spherize_voxel {

Lattice::Lattice(const Solid& solid, const std::array<Vec3, 3>& axes, Cell::Content content, double spacing)
    : whole_(Cell::whole(solid, axes, content)), middle_(solid.bounds().center()), spacing_(spacing) {}

double Lattice::largest_radius() const {
    const Vec3 size = whole_.box().size();
    return std::max({size.x, size.y, size.z}) * (1 - 1e-6) / spacing_;
}

std::array<double, 3> Lattice::counts(double radius) const {
    std::array<double, 3> counts;
    const Vec3 size = whole_.box().size();
    for (int axis = 0; axis < 3; ++axis) {
        // A side of an integral number of voxels must not get one more because of a rounding error.
        counts[static_cast<std::size_t>(axis)] = std::max(1.0, std::ceil(size[axis] / (spacing_ * radius) - 1e-9));
    }
    return counts;
}

double Lattice::voxels_of_box(double radius) const {
    const auto [x, y, z] = counts(radius);
    return x * y * z;
}

std::vector<Cell> Lattice::filled(double radius) const {
    const auto [x, y, z] = counts(radius);
    const Vec3 half = Vec3{x, y, z} * (spacing_ * radius / 2), center = whole_.box().center();
    return whole_.in_box({center - half, center + half})
        .divided({static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)});
}

std::vector<Sphere> Lattice::spheres(const std::vector<Cell>& voxels, double radius) const {
    if (voxels.size() == 1) {
        return {whole_.ball()};
    }
    std::vector<Sphere> spheres;
    for (const Cell& voxel : voxels) {
        check_cancelled();
        const Vec3 local = voxel.box().center();
        const auto& axes = voxel.axes();
        spheres.push_back({middle_ + local.x * axes[0] + local.y * axes[1] + local.z * axes[2], radius});
    }
    return spheres;
}

} // namespace foam::spherize_voxel
