// The directions of a ball's surface that lie outside all other balls.
#pragma once

#include "cover/measured/points.hpp"

#include <cstdint>
#include <numbers>
#include <span>

namespace foam::inline search::cover {

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

} // namespace foam::search::cover
