#include "power_law.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline bench::experiment {

std::optional<PowerLaw> fitted_power_law(const std::vector<std::pair<double, double>>& points) {
    constexpr double upper_range = 0.1;
    PowerLaw law;
    for (const auto& [x, y] : points) {
        law.to = y > 0 ? std::max(law.to, x) : law.to;
    }
    law.from = law.to;
    std::size_t count = 0;
    double mean_x = 0, mean_y = 0;
    const auto counts = [&](const auto& point) {
        return point.first > 0 && point.second > 0 && point.first >= upper_range * law.to;
    };
    for (const auto& point : points) {
        if (counts(point)) {
            law.from = std::min(law.from, point.first);
            mean_x += std::log(point.first);
            mean_y += std::log(point.second);
            ++count;
        }
    }
    if (count < 3) {
        return {};
    }
    mean_x /= static_cast<double>(count);
    mean_y /= static_cast<double>(count);
    double variance = 0, covariance = 0;
    for (const auto& point : points) {
        if (counts(point)) {
            const double dx = std::log(point.first) - mean_x;
            variance += dx * dx;
            covariance += dx * (std::log(point.second) - mean_y);
        }
    }
    if (!(variance > 0)) {
        return {};
    }
    law.exponent = covariance / variance;
    law.factor = std::exp(mean_y - law.exponent * mean_x);
    return law;
}

} // namespace foam::bench::experiment
