#include "scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline report::plot {
namespace {

constexpr std::array<int, 3> round_steps{1, 2, 5};

/// Returns digit · 10^exponent, the nearest double.
double round_number(int digit, int exponent) {
    return exponent < 0 ? digit / std::pow(10.0, -exponent) : digit * std::pow(10.0, exponent);
}

/// Returns the largest of 1, 2, 5, 10, 20, … (or 0.5, 0.2, …) that is at most `value`.
double round_below(double value) {
    const int exponent = static_cast<int>(std::floor(std::log10(value))) - 1; // one lower: the logarithm is rounded
    double best = round_number(1, exponent);
    for (int e = exponent; e <= exponent + 2; ++e) {
        for (const int digit : round_steps) {
            best = round_number(digit, e) <= value ? round_number(digit, e) : best;
        }
    }
    return best;
}

} // namespace

std::string tick_label(double value) {
    const double size = std::abs(value);
    if (size >= 1e6) {
        return fmt::format("{:g}M", value / 1e6);
    }
    return size >= 1e4 ? fmt::format("{:g}k", value / 1e3) : fmt::format("{:g}", value);
}

Scale scale_over(const std::vector<double>& values) {
    constexpr double wanted = 5;
    double low = 0, high = 0;
    for (const double value : values) {
        low = std::isfinite(value) ? std::min(low, value) : low;
        high = std::isfinite(value) ? std::max(high, value) : high;
    }
    if (!(high > low)) {
        high = low + 1;
    }
    const double step = round_below((high - low) / wanted);
    const double first = std::floor(low / step), last = std::ceil(high / step);
    Scale scale{.low = first * step, .high = last * step, .ticks = {}};
    for (double k = first; k <= last; ++k) {
        scale.ticks.push_back({k * step, tick_label(k * step)});
    }
    return scale;
}

} // namespace foam::inline report::plot
