// Which balls are near, which of their surface is exposed, which points each alone holds.
#pragma once

#include "by_spheres/measured/points.hpp"

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace foam::inline search::by_spheres {

/// For each ball, the balls whose surfaces come near its own. The lists are longer than necessary by a margin, so that
/// they stay valid while balls move by less.
class NearBalls {
public:
    /// Finds the neighbours anew if the balls have moved too far, or if their number has changed; else O(n). The lists
    /// serve gaps up to `gap` at least.
    void update(const Balls& balls, float gap = 0);
    /// Returns all balls that come to within `gap` of ball `i`, ascending, and perhaps some more. What is returned is
    /// valid until the next call.
    std::span<const std::uint32_t> of(std::size_t i, float gap = 0);
    /// Returns the largest gap for which of() looks nothing up.
    float listed_gap() const { return left_; }

private:
    void find(const Balls& balls, float gap);
    /// Finds balls that come to within more than listed_gap().
    void look_up(std::size_t i, float gap);

    Balls then_;                       ///< the balls of the last search
    float margin_ = 0;                 ///< of that search
    float left_ = -1;                  ///< what moves since then have left of it
    std::vector<std::uint32_t> order_; ///< the balls by their low ends along x
    std::vector<float> high_;          ///< the highest end along x of each of these and those before it
    std::vector<std::vector<std::uint32_t>> lists_;
    std::vector<std::uint32_t> looked_up_;
};

class Exposed {
public:
    /// Computes the exposed directions. Returns false if the ball has no surface outside the others.
    bool look(const Balls& balls, std::size_t i, const Points& directions);
    /// The same. `near`: all balls that may meet ball i.
    bool look(const Balls& balls, std::size_t i, const Points& directions, std::span<const std::uint32_t> near);
    /// Returns a value for each direction of the last look(): positive outside all other balls. In units of length², it
    /// falls to zero linearly with the distance from the nearest other ball.
    const std::vector<float>& depth() const { return depth_; }

    /// A linear function of a direction.
    struct Linear {
        float constant, x, y, z;
    };

private:
    std::vector<Linear> functions_; ///< for each ball that meets the one looked at
    std::vector<std::uint32_t> all_;
    std::vector<float> depth_;
};

/// The derivative by the centre and the radius of a ball.
struct Slope {
    float x = 0, y = 0, z = 0, r = 0;
};

/// Returns the integral of weight(x, y, z), and of the normal times it, over the part of the surface of the last ball
/// looked at that lies outside all others. It is the shape derivative of the weight's integral over the union.
template <class Weight>
Slope slope_of(const Exposed& exposed, const Ball& ball, const Points& directions, Weight weight) {
    Slope sum;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (exposed.depth()[k] > 0) {
            const float nx = directions.x[k], ny = directions.y[k], nz = directions.z[k];
            const float w = weight(ball.x + ball.r * nx, ball.y + ball.r * ny, ball.z + ball.r * nz);
            sum.x += w * nx;
            sum.y += w * ny;
            sum.z += w * nz;
            sum.r += w;
        }
    }
    const float area = 4 * std::numbers::pi_v<float> * ball.r * ball.r / static_cast<float>(directions.size());
    return {area * sum.x, area * sum.y, area * sum.z, area * sum.r};
}

/// A point and the ball that should contain it.
struct Held {
    float x, y, z;
    float force; ///< how far the ball moved towards it
    std::uint32_t owner, point;
};

/// Applies the least change of the balls by which each contains its points: the projection onto linearised constraints
/// by Hildreth's method (1957), force by force, for some sweeps. Points active in the first sweep are visited again in
/// every sweep, the others once more at the end: if likely active points come first, most of the others are already
/// contained. `held` is reordered; `pressed[point]` marks the points that are active in the end.
void take_in(std::vector<Held>& held, Balls& balls, std::vector<char>& pressed);

} // namespace foam::inline search::by_spheres
