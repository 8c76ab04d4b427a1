#include "exposed.hpp"

#include <algorithm>

namespace foam::inline search::cover {

bool Exposed::look(const Balls& balls, std::size_t i, const Points& directions) {
    const std::size_t count = directions.size();
    depth_.assign(count, 1e9f);
    const Ball ball = balls[i];
    if (!(ball.r > 0)) {
        return false;
    }
    for (std::size_t j = 0; j < balls.size(); ++j) {
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
        const float constant = squared + ball.r * ball.r - other.r * other.r;
        const float ax = 2 * ball.r * dx, ay = 2 * ball.r * dy, az = 2 * ball.r * dz;
        const float *nx = directions.x.data(), *ny = directions.y.data(), *nz = directions.z.data();
        float* depth = depth_.data();
        for (std::size_t k = 0; k < count; ++k) {
            const float d = constant + ax * nx[k] + ay * ny[k] + az * nz[k];
            depth[k] = d < depth[k] ? d : depth[k];
        }
    }
    return true;
}

} // namespace foam::search::cover
