#include "by_spheres/moves/near_balls.hpp"

#include "by_spheres/measured/points.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace foam::inline search::by_spheres {

/// Finds the least of some linear functions of each direction.
FOAM_FOR_WIDE_VECTORS
static void find_least(std::span<const Exposed::Linear> functions, const Points& directions, float* least) {
    // Hot loop of the search, vectorised by hand: eight directions at a time.
    using Lanes = float __attribute__((vector_size(32)));
    constexpr std::size_t lanes = 8;
    const auto load = [](const float* values, Lanes& result) { std::memcpy(&result, values, sizeof result); };
    const std::size_t count = directions.size(), whole = count / lanes * lanes;
    for (std::size_t k = 0; k < whole; k += lanes) {
        Lanes x, y, z, most;
        load(&directions.x[k], x);
        load(&directions.y[k], y);
        load(&directions.z[k], z);
        load(&least[k], most);
        for (const Exposed::Linear& f : functions) {
            const Lanes d = f.constant + f.x * x + f.y * y + f.z * z;
            most = d < most ? d : most;
        }
        std::memcpy(&least[k], &most, sizeof most);
    }
    for (std::size_t k = whole; k < count; ++k) {
        for (const Exposed::Linear& f : functions) {
            const float d = f.constant + f.x * directions.x[k] + f.y * directions.y[k] + f.z * directions.z[k];
            least[k] = d < least[k] ? d : least[k];
        }
    }
}

bool Exposed::look(const Balls& balls, std::size_t i, const Points& directions) {
    all_.resize(balls.size());
    std::iota(all_.begin(), all_.end(), 0u);
    return look(balls, i, directions, all_);
}

bool Exposed::look(const Balls& balls, std::size_t i, const Points& directions, std::span<const std::uint32_t> near) {
    const Ball ball = balls[i];
    if (!(ball.r > 0)) {
        return false;
    }
    functions_.clear();
    for (const std::uint32_t j : near) {
        const Ball& other = balls[j];
        const float sum = ball.r + other.r, squared = squared_distance(ball, other);
        if (j == i || squared >= sum * sum) {
            continue;
        }
        const float margin = other.r - ball.r;
        if (squared <= margin * margin && (margin > 0 || (margin == 0 && j < i))) {
            return false; // the other contains the whole ball; of equal balls the first counts
        }
        if (squared <= margin * margin) {
            continue; // the ball contains the other
        }
        // c + r n - c'|² - r'² is linear in the direction n.
        const float dx = ball.x - other.x, dy = ball.y - other.y, dz = ball.z - other.z;
        functions_.push_back(
            {squared + ball.r * ball.r - other.r * other.r, 2 * ball.r * dx, 2 * ball.r * dy, 2 * ball.r * dz});
    }
    depth_.assign(directions.size(), 1e9f);
    find_least(functions_, directions, depth_.data());
    return true;
}

} // namespace foam::search::by_spheres
