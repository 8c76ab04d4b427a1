#include "allocation.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace foam {

double CostCurve::least() const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [count, cost] : known_) {
        least = std::min(least, cost);
    }
    return least;
}

std::size_t CostCurve::demand(double price) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [count, cost] : known_) {
        if (const double sum = cost + price * static_cast<double>(count); sum <= least) {
            least = sum;
            best = count;
        }
    }
    return best;
}

std::vector<std::size_t> allocate_at_most(const std::vector<const CostCurve*>& curves, std::size_t total) {
    constexpr double impossible = std::numeric_limits<double>::infinity();
    const std::size_t columns = total + 1;
    // best[sum]: least cost of the curves so far with counts that add up to `sum`
    std::vector<double> best(columns, impossible), next(columns);
    std::vector<std::uint32_t> choice(curves.size() * columns, 0);
    best[0] = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        std::fill(next.begin(), next.end(), impossible);
        for (const auto& [count, cost] : curves[i]->known()) {
            for (std::size_t sum = count; sum <= total; ++sum) {
                if (best[sum - count] + cost < next[sum]) {
                    next[sum] = best[sum - count] + cost;
                    choice[i * columns + sum] = static_cast<std::uint32_t>(count);
                }
            }
        }
        std::swap(best, next);
    }
    const auto least = std::min_element(best.begin(), best.end());
    if (*least == impossible) {
        return {};
    }
    std::size_t sum = static_cast<std::size_t>(least - best.begin());
    std::vector<std::size_t> counts(curves.size());
    for (std::size_t i = curves.size(); i-- > 0;) {
        counts[i] = choice[i * columns + sum];
        sum -= counts[i];
    }
    return counts;
}

/// The least number of the ladder above `count`: 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40…
static std::size_t rung_above(std::size_t count) {
    const std::size_t octave = std::bit_floor(std::max<std::size_t>(count, 4)), step = octave / 4;
    return count - count % step + step;
}

std::vector<std::size_t> next_rungs(std::size_t explored, std::size_t least, std::size_t most) {
    constexpr std::size_t at_first = 4, later = 2;
    std::vector<std::size_t> rungs;
    std::size_t count = explored;
    while (count < most && rungs.size() < (explored == 0 ? at_first : later)) {
        count = std::clamp(rung_above(count), least, most);
        rungs.push_back(count);
    }
    return rungs;
}

} // namespace foam
