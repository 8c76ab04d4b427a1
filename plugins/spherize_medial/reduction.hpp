// From many medial spheres to few (Bradshaw and O'Sullivan 2004, section 5). All reductions return balls that contain
// the given cover points; the cost (Columns::outside) decides which result is best.
#pragma once

#include "columns.hpp"

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <map>
#include <span>
#include <vector>

namespace foam::medial {

/// Returns for each point the ball that it is nearest to or deepest in: least |p − c| − r.
std::vector<std::uint32_t> assign(std::span<const Vec3> points, std::span<const Sphere> balls);
/// Returns the points of each ball.
std::vector<std::vector<Vec3>> grouped(std::span<const Vec3> points, std::span<const std::uint32_t> owner,
                                       std::size_t count);
/// Alternates assignment of points to balls and enclosing balls of the assigned points (Lloyd's scheme on balls; Wang
/// et al. 2006, section 4.1) for some rounds. Returns the balls of the least cost. Balls that lose all points get part
/// of the ball with the largest cost.
std::vector<Sphere> fitted(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns, int rounds);

/// Expand: all medial spheres extend beyond the surface by the same stand-off; greedily chooses those with most points
/// that are not covered yet; finds the least stand-off for which `count` spheres suffice.
class Expand {
public:
    Expand(std::span<const Vec3> points, std::span<const Sphere> medial);
    /// Returns at most `count` balls; empty if there is no medial sphere.
    std::vector<Sphere> cover(std::size_t count);

private:
    using Chosen = std::vector<std::uint32_t>;
    Chosen greedy(double stand_off) const;

    std::size_t points_;
    std::vector<Sphere> medial_;
    std::vector<float> gap_; ///< of point p to medial sphere m at [m · points + p]: how far p is outside
    double greatest_ = 0;    ///< stand-off for which one sphere suffices
    std::map<double, Chosen> known_;
};

/// Merge: unites the pair of neighbours with the least cost, from `balls` down to one. Element n − 1: the remaining n
/// balls.
std::vector<std::vector<Sphere>> merge(std::span<const Vec3> points, std::span<const Sphere> balls,
                                       const Columns& columns, Context& context);

/// Burst: removes the ball whose points add the least cost to its neighbours, down to `count`.
std::vector<Sphere> burst(std::span<const Vec3> points, std::vector<Sphere> balls, std::size_t count,
                          const Columns& columns, Context& context);

/// Divides the points by planes, each time where it saves most, without a medial axis. Element n − 1: n enclosing
/// balls. Ends early where points cannot be separated.
std::vector<std::vector<Sphere>> divide(std::span<const Vec3> points, std::size_t count, const Columns& columns,
                                        Context& context);

} // namespace foam::medial
