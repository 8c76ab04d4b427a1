// Spheres placed one after another without a medial axis (Bradshaw and O'Sullivan 2004, section 5.3, "spawning").
#pragma once

#include "columns.hpp"

#include <foam/context.hpp>
#include <foam/sphere.hpp>

#include <map>
#include <span>
#include <vector>

namespace foam::medial {

/// Points inside the solid on a grid of about `count` points over the box of `points`, each with its distance to the
/// nearest of them as the radius; and some of the points themselves, of radius 0, for solids too thin for the grid.
std::vector<Sphere> grid_seeds(std::span<const Vec3> points, const Columns& columns, std::size_t count);
/// Those that hold one of the points, or nearly.
std::vector<Sphere> touching_seeds(std::span<const Sphere> seeds, std::span<const Vec3> points);

/// All spheres hang over the surface by the same stand-off. The next sphere starts from the seed that holds most points
/// that are not held yet and moves to where it holds still more; the least stand-off that gets by with `count`.
class Spawn {
public:
    /// `most`: the largest count that will be asked for.
    Spawn(std::span<const Vec3> points, std::span<const Sphere> seeds, const Columns& columns, std::size_t most);
    /// At most `count` balls; empty if there is no seed.
    std::vector<Sphere> cover(std::size_t count, Context& context);

private:
    std::vector<Sphere> placed(double stand_off, Context& context) const;
    Sphere moved(const Sphere& start, double stand_off, std::span<const Vec3> open) const;
    double depth(const Vec3& p) const;

    std::vector<Vec3> points_;
    std::vector<Sphere> seeds_;
    const Columns& columns_;
    std::size_t most_;
    double greatest_ = 0; ///< stand-off with which one sphere is enough
    std::map<double, std::vector<Sphere>> known_;
};

} // namespace foam::medial
