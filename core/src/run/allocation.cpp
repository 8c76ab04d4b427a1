#include "allocation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace foam {

double CostCurve::at(std::size_t count) const {
    const auto above = known_.lower_bound(count);
    if (above != known_.end() && above->first == count) {
        return above->second;
    }
    if (above == known_.begin()) {
        return above->second;
    }
    const auto below = std::prev(above);
    const double from = std::log(static_cast<double>(below->first)), x = std::log(static_cast<double>(count));
    // A cost of nearly zero (a sphere that is a sphere) has no logarithm worth following.
    constexpr double tiny = 1e-300;
    const double low = std::log(std::max(below->second, tiny));
    double slope = -0.4;
    if (above != known_.end()) {
        slope = (std::log(std::max(above->second, tiny)) - low) / (std::log(static_cast<double>(above->first)) - from);
    }
    return std::exp(low + slope * (x - from));
}

std::vector<std::size_t> allocate(const std::vector<Claim>& claims, std::size_t total) {
    constexpr double impossible = std::numeric_limits<double>::infinity();
    const std::size_t columns = total + 1;
    std::vector<double> best(columns, impossible), next(columns);
    std::vector<std::uint32_t> choice(claims.size() * columns, 0);
    best[0] = 0;
    for (std::size_t i = 0; i < claims.size(); ++i) {
        const Claim& claim = claims[i];
        std::fill(next.begin(), next.end(), impossible);
        for (std::size_t count = claim.least; count <= std::min(claim.most, total); ++count) {
            if (claim.known_only && !claim.curve->knows(count)) {
                continue;
            }
            const double cost = claim.curve->at(count);
            for (std::size_t sum = count; sum <= total; ++sum) {
                if (best[sum - count] + cost < next[sum]) {
                    next[sum] = best[sum - count] + cost;
                    choice[i * columns + sum] = static_cast<std::uint32_t>(count);
                }
            }
        }
        std::swap(best, next);
    }
    if (best[total] == impossible) {
        return {};
    }
    std::vector<std::size_t> counts(claims.size());
    for (std::size_t i = claims.size(), sum = total; i-- > 0;) {
        counts[i] = choice[i * columns + sum];
        sum -= counts[i];
    }
    return counts;
}

} // namespace foam
