#include "scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline report::plot {
namespace {

constexpr std::array<int, 3> round_steps{1, 2, 5};

/// digit · 10^exponent, the nearest double.
double round_number(int digit, int exponent) {
    return exponent < 0 ? digit / std::pow(10.0, -exponent) : digit * std::pow(10.0, exponent);
}

/// The largest of 1, 2, 5, 10, 20, … (or 0.5, 0.2, …) that is at most `value`.
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

/// The least of those numbers that is at least `value`.
double round_above(double value) {
    const int exponent = static_cast<int>(std::floor(std::log10(value))) - 1;
    for (int e = exponent;; ++e) {
        for (const int digit : round_steps) {
            if (round_number(digit, e) >= value) {
                return round_number(digit, e);
            }
        }
    }
}

/// Decades are labelled, and 2 and 5 where there are few of them; every digit has a tick.
void add_logarithmic_ticks(Scale& scale) {
    const double decades = std::log10(scale.high / scale.low);
    const int first = static_cast<int>(std::floor(std::log10(scale.low))) - 1;
    for (int exponent = first; round_number(1, exponent) <= scale.high; ++exponent) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = round_number(digit, exponent);
            if (value < scale.low || value > scale.high) {
                continue;
            }
            const bool labelled = digit == 1 || (decades < 2.5 && (digit == 2 || digit == 5));
            scale.ticks.push_back({value, labelled ? tick_label(value) : ""});
        }
    }
}

void add_linear_ticks(Scale& scale) {
    constexpr double wanted = 5;
    const double step = round_below((scale.high - scale.low) / wanted);
    const double first = std::floor(scale.low / step), last = std::ceil(scale.high / step);
    for (double k = first; k <= last; ++k) {
        scale.ticks.push_back({k * step, tick_label(k * step)});
    }
    scale.low = first * step;
    scale.high = last * step;
}

} // namespace

std::string tick_label(double value) {
    const double size = std::abs(value);
    if (size >= 1e6) {
        return fmt::format("{:g}M", value / 1e6);
    }
    return size >= 1e4 ? fmt::format("{:g}k", value / 1e3) : fmt::format("{:g}", value);
}

double Scale::position(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

bool Scale::holds(double value) const {
    return std::isfinite(value) && (!logarithmic || value > 0);
}

Scale scale_over(const Axis& axis, const std::vector<double>& values) {
    Scale scale;
    scale.logarithmic = axis.logarithmic;
    std::vector<double> drawn = axis.ticks;
    std::copy_if(values.begin(), values.end(), std::back_inserter(drawn), [&](double v) { return scale.holds(v); });
    if (drawn.empty()) {
        drawn = {1, 10};
    }
    const auto [least, most] = std::minmax_element(drawn.begin(), drawn.end());
    scale.low = scale.logarithmic ? *least : std::min(0.0, *least);
    scale.high = scale.logarithmic ? *most : std::max(0.0, *most);
    if (!(scale.high > scale.low)) {
        scale.high = scale.logarithmic ? 10 * scale.low : scale.low + 1;
    }
    if (!axis.ticks.empty()) {
        for (const double value : axis.ticks) {
            scale.ticks.push_back({value, tick_label(value)});
        }
    } else if (scale.logarithmic) {
        scale.low = round_below(scale.low);
        scale.high = round_above(scale.high);
        add_logarithmic_ticks(scale);
    } else {
        add_linear_ticks(scale);
    }
    return scale;
}

} // namespace foam::report::plot
