// From many medial spheres to few (Bradshaw and O'Sullivan 2004, section 5). All reductions answer with balls that hold
// the cover points they were given; which of them did best is for the cost (Columns::outside) to say.
#pragma once

#include "columns.hpp"

#include <foam/context.hpp>
#include <foam/sphere.hpp>

#include <map>
#include <span>
#include <vector>

namespace foam::medial {

/// For each point the ball it is nearest to or deepest in: least |p − c| − r.
std::vector<std::uint32_t> assign(std::span<const Vec3> points, std::span<const Sphere> balls);
/// The points of each ball.
std::vector<std::vector<Vec3>> grouped(std::span<const Vec3> points, std::span<const std::uint32_t> owner,
                                       std::size_t count);
/// Assignment of points to balls and enclosing balls of the assigned in turn (Lloyd's scheme on balls; Wang et al.
/// 2006, section 4.1) for some rounds; the cheapest cover met. Balls that lose all points are given part of the
/// costliest one.
std::vector<Sphere> fitted(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns, int rounds);

/// Expand: all medial spheres hang over the surface by the same stand-off; greedily the ones that hold most points that
/// are not held yet; the least stand-off that gets by with `count`.
class Expand {
public:
    Expand(std::span<const Vec3> points, std::span<const Sphere> medial);
    /// At most `count` balls; empty if there is no medial sphere.
    std::vector<Sphere> cover(std::size_t count);

private:
    using Chosen = std::vector<std::uint32_t>;
    Chosen greedy(double stand_off) const;

    std::size_t points_;
    std::vector<Sphere> medial_;
    std::vector<float> gap_; ///< of point p to medial sphere m at [m · points + p]: how far p is outside
    double greatest_ = 0;    ///< stand-off with which one sphere is enough
    std::map<double, Chosen> known_;
};

/// Merge: unites the pair of neighbours that costs least, from `balls` down to one. element n − 1: the n balls left.
std::vector<std::vector<Sphere>> merge(std::span<const Vec3> points, std::span<const Sphere> balls,
                                       const Columns& columns, Context& context);

/// Burst: removes the ball whose points cost its neighbours least, down to `count`.
std::vector<Sphere> burst(std::span<const Vec3> points, std::vector<Sphere> balls, std::size_t count,
                          const Columns& columns, Context& context);

/// Divides the points by planes, each time where it saves most: needs no medial axis. Element n − 1: n enclosing balls;
/// ends early where points cannot be told apart.
std::vector<std::vector<Sphere>> divide(std::span<const Vec3> points, std::size_t count, const Columns& columns,
                                        Context& context);

} // namespace foam::medial
