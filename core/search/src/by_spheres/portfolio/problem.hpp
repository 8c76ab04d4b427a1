// What the searches are asked, and what they hand on.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"

#include <foam/base/internal/ladder.hpp>
#include <foam/search/spherize.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>

namespace foam::inline search::by_spheres {

struct Problem {
    const Solid* solid;
    Frame frame;
    Occupancy occupancy;
    Points surface; ///< places to cover: vertices and points spread evenly over the area
    double volume;  ///< units³

    /// `resolution`: of the occupancy; `points`: the approximate number of places on the surface.
    Problem(const Solid& solid, int resolution, std::size_t points, std::uint64_t seed);
};

/// For each point, the ball in which it lies deepest, and its distance outside that ball (negative inside).
struct Deepest {
    std::vector<std::uint32_t> ball;
    std::vector<float> gap;

    /// Resets to `count` points without a ball.
    void clear(std::size_t count);
    /// Assigns to the balls `named` those of the points from `begin` to `end` that lie deeper in one of them than in
    /// their ball so far. Of equal balls, the first counts.
    void offer(const Points& points, std::size_t begin, std::size_t end, const Balls& balls,
               std::span<const std::uint32_t> named);
};
void find_owners(const Points& points, const Balls& balls, Deepest& owners);

/// Sets each radius to the least that contains the points that lie deepest in the ball. It takes a few rounds, as a
/// smaller ball may leave points to others.
void tighten(const Points& points, Balls& balls);

/// Balls with their indices, ascending.
struct Rivals {
    Points centers;
    std::vector<float> radius;
    std::vector<std::int32_t> index;

    std::size_t size() const { return index.size(); }
};

Rivals all_rivals(const Balls& balls);

/// Finds the balls whose power |p - c|² - r² may be least at some of the points in a box. The difference of two powers
/// is linear, so its least value over a box follows from that at the middle.
class RivalSearch {
public:
    /// Writes those of `from` that may have the least power at one of the points from `begin` to `end` to `result`.
    /// None is left out whose power, with the rounding of single precision, is the least or equal to it.
    void find(const Rivals& from, const Points& points, std::size_t begin, std::size_t end, Rivals& result);

private:
    std::vector<float> power_, above_;
};

/// A ball satisfies the limit if normal · centre + radius <= offset. For a half-space the normal is a unit vector that
/// points out of it; a shorter normal with a proportional offset leaves room for the ball to grow by a share of its
/// radius.
struct Limit {
    Vec3 normal;
    double offset = 0; ///< units
};
using Limits = std::vector<Limit>;

/// Returns by how much a ball exceeds its most violated limit; 0 if it satisfies all.
double beyond(const Ball& ball, const Limits& limits);

/// The ball that contains some points, satisfies the limits and has the least radius + tilt · centre. Limits enter the
/// cost at prices λ (Lagrange multipliers): radius + tilt · centre + Σ λ (normal · centre + radius). Up to a factor,
/// this is the cost of a ball without limits with the tilt (tilt + Σ λ normal) / (1 + Σ λ). The prices are found one
/// after another until the limits are satisfied. A half-space is the limit of balls of rising radius, so such a ball
/// always exists for one limit if the points satisfy it; between several limits there may be none.
class LimitedBall {
public:
    explicit LimitedBall(Limits limits = {}) : limits_(std::move(limits)), prices_(limits_.size(), 0) {}

    /// Returns the ball of the first `count` points; without points, a ball without radius. `near`: an estimate of the
    /// result. If there is no such ball, it returns one that contains the points.
    Ball of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near);

private:
    /// Sets the price of one limit, given the others'.
    Ball kept_to(std::size_t limit, const Points& points, std::size_t count, const Vec3& tilt, const Ball& now);

    Limits limits_;
    std::vector<double> prices_;
    EnclosingBall enclosing_ball_;
};

/// Calls work(). From its cancellation checks in the calling thread, stop() is called every few milliseconds; once it
/// returns true, the work ends at its next check in any thread. Returns whether the work was completed. Without `stop`
/// it always is. Exceptions of stop() pass through; so does Error(cancelled) of a request that was there before.
bool completed_unless_stopped(const std::function<bool()>& stop, const std::function<void()>& work);

/// Balls with the volume that they have when they cover the surface, units³.
struct CoverCandidate {
    double volume = 0;
    Balls balls;
};

inline bool has_less_volume(const CoverCandidate& a, const CoverCandidate& b) {
    return a.volume < b.volume;
}

/// Largest count that builds on smaller ones. Larger counts are searched by themselves: they are only compared with
/// this one.
constexpr std::size_t most_growing = 64;

/// Returns the candidate count below a count of at least 2: 1 to 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64.
constexpr std::size_t count_before(std::size_t count) {
    if (count > most_growing) {
        return most_growing;
    }
    std::size_t before = 1;
    while (rung_above(before) < count) {
        before = rung_above(before);
    }
    return before;
}

/// Returns the same for Effort::fast: above 8 balls only 16, 32 and 64 are candidates.
constexpr std::size_t quick_count_before(std::size_t count) {
    constexpr std::size_t few = 8;
    return count <= few ? count_before(count) : std::min(std::bit_floor(count - 1), most_growing);
}

/// Returns whether a candidate count above 16 lies between those of two per octave: 20, 28, 40, 56.
constexpr bool is_between(std::size_t count) {
    return rung_above(count - 1) == count && sparse_rung_above(count - 1) != count;
}

/// Returns the smallest ball around the surface, in the unit frame.
Ball smallest_ball(const Solid& solid, const Frame& frame);

/// Returns balls of the unit frame as slightly larger spheres. Balls of a search contain their parts to some
/// millionths; with the overlap the proof needs no growth.
std::vector<Sphere> with_a_hair_of_overlap(const Frame& frame, const Balls& balls);

/// Returns balls of the unit frame as slightly larger spheres, with the proof that they cover the surface. They are
/// grown if they do not.
SphereCover proved(const Solid& solid, const Frame& frame, const Balls& balls);

} // namespace foam::inline search::by_spheres
