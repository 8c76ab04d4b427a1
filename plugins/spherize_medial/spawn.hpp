// Spheres placed one after another without a medial axis (Bradshaw and O'Sullivan 2004, section 5.3, "spawning").
#pragma once

#include "columns.hpp"

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <map>
#include <span>
#include <vector>

namespace foam::medial {

/// Returns points inside the solid on a grid of about `count` points over the box of `points`, each with its distance
/// to the nearest of them as the radius; and some of the points themselves, of radius 0, for solids too thin for the
/// grid.
std::vector<Sphere> grid_seeds(std::span<const Vec3> points, const Columns& columns, std::size_t count);
/// Returns the seeds that contain one of the points, or nearly.
std::vector<Sphere> touching_seeds(std::span<const Sphere> seeds, std::span<const Vec3> points);

/// Spawning: all spheres extend beyond the surface by the same stand-off. The next sphere starts from the seed with
/// most points that are not covered yet, and moves to where it contains more. Finds the least stand-off for which
/// `count` spheres suffice.
class Spawn {
public:
    /// Prepares the search. `most`: the largest count that is requested later.
    Spawn(std::span<const Vec3> points, std::span<const Sphere> seeds, const Columns& columns, std::size_t most);
    /// Returns at most `count` balls; empty if there is no seed.
    std::vector<Sphere> cover(std::size_t count, Context& context);

private:
    std::vector<Sphere> placed(double stand_off, Context& context) const;
    Sphere moved(const Sphere& start, double stand_off, std::span<const Vec3> open) const;
    double depth(const Vec3& p) const;

    std::vector<Vec3> points_;
    std::vector<Sphere> seeds_;
    const Columns& columns_;
    std::size_t most_;
    double greatest_ = 0; ///< stand-off for which one sphere suffices
    std::map<double, std::vector<Sphere>> known_;
};

} // namespace foam::medial
