#include "radius_search.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::spherize_voxel {
namespace {

constexpr std::size_t rungs_per_octave = 12; ///< radii between one and its half
constexpr std::size_t directions = 300;      ///< of union_volume(): well below a per cent of error

} // namespace

RadiusSearch::Rung& RadiusSearch::rung(std::size_t index) {
    while (rungs_.size() <= index) {
        check_cancelled();
        const double octaves = static_cast<double>(rungs_.size()) / rungs_per_octave;
        rungs_.push_back({lattice_.largest_radius() * std::exp2(-octaves), false, 0, -1});
    }
    return rungs_[index];
}

/// Fills in an octave of radii for a search among at most `most` spheres.
void RadiusSearch::look_at(std::size_t first, std::size_t most, Context& context) {
    rung(first + rungs_per_octave - 1);
    parallel_for(rungs_per_octave, [&](std::size_t i) {
        Rung& rung = rungs_[first + i];
        if (lattice_.voxels_of_box(rung.radius) > most_voxels(most) || (rung.looked_at && rung.count > most) ||
            rung.volume >= 0) {
            return;
        }
        context.check_cancelled();
        const std::vector<Cell> voxels = lattice_.filled(rung.radius);
        rung.count = voxels.size();
        rung.looked_at = true;
        if (rung.count <= most) {
            rung.volume = union_volume(lattice_.spheres(voxels, rung.radius), directions);
        }
    });
}

RadiusSearch::Result RadiusSearch::best(std::size_t most, Context& context) {
    const auto too_many = [&](const Rung& rung) {
        return lattice_.voxels_of_box(rung.radius) > most_voxels(most) || rung.count > 2 * most;
    };
    std::size_t best = 0;
    double least = union_volume(std::vector<Sphere>{lattice_.whole().ball()}, directions);
    bool one = true, more = lattice_.largest_radius() > 0;
    for (std::size_t first = 0; more; first += rungs_per_octave) {
        look_at(first, most, context);
        for (std::size_t i = first; more && i < first + rungs_per_octave; ++i) {
            const Rung& rung = rungs_[i];
            more = !too_many(rung);
            if (more && rung.count <= most && rung.volume < least) {
                least = rung.volume;
                best = i;
                one = false;
            }
        }
    }
    if (one) {
        return {{lattice_.whole()}, {lattice_.whole().ball()}};
    }
    std::vector<Cell> voxels = lattice_.filled(rungs_[best].radius);
    std::vector<Sphere> spheres = lattice_.spheres(voxels, rungs_[best].radius);
    return {std::move(voxels), std::move(spheres)};
}

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
