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

namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

/// Dynamic programme over the claims.
class Programme {
public:
    Programme(const std::vector<Claim>& claims, std::size_t total)
        : columns_(total + 1), best_(columns_, impossible), choice_(claims.size() * columns_, 0),
          claims_(claims.size()) {
        best_[0] = 0;
        std::vector<double> next(columns_);
        for (std::size_t i = 0; i < claims.size(); ++i) {
            const Claim& claim = claims[i];
            std::fill(next.begin(), next.end(), impossible);
            for (std::size_t count = claim.least; count <= std::min(claim.most, total); ++count) {
                if (claim.known_only && !claim.curve->knows(count)) {
                    continue;
                }
                const double cost = claim.curve->at(count);
                for (std::size_t sum = count; sum <= total; ++sum) {
                    if (best_[sum - count] + cost < next[sum]) {
                        next[sum] = best_[sum - count] + cost;
                        choice_[i * columns_ + sum] = static_cast<std::uint32_t>(count);
                    }
                }
            }
            std::swap(best_, next);
        }
    }

    /// The least cost of counts that add up to `sum`.
    double cost(std::size_t sum) const { return best_[sum]; }

    std::vector<std::size_t> counts(std::size_t sum) const {
        std::vector<std::size_t> counts(claims_);
        for (std::size_t i = claims_; i-- > 0;) {
            counts[i] = choice_[i * columns_ + sum];
            sum -= counts[i];
        }
        return counts;
    }

private:
    std::size_t columns_;
    std::vector<double> best_;
    std::vector<std::uint32_t> choice_;
    std::size_t claims_;
};

} // namespace

std::vector<std::size_t> allocate(const std::vector<Claim>& claims, std::size_t total) {
    const Programme programme(claims, total);
    return programme.cost(total) == impossible ? std::vector<std::size_t>{} : programme.counts(total);
}

std::vector<std::size_t> allocate_at_most(const std::vector<Claim>& claims, std::size_t total) {
    const Programme programme(claims, total);
    double least = impossible;
    for (std::size_t sum = 0; sum <= total; ++sum) {
        least = std::min(least, programme.cost(sum));
    }
    if (least == impossible) {
        return {};
    }
    constexpr double accuracy = 1e-3;
    std::size_t sum = total;
    while (programme.cost(sum) > least * (1 + accuracy)) {
        --sum;
    }
    return programme.counts(sum);
}

} // namespace foam
