// Where a value lies on an axis, and which values are labelled.
#pragma once

#include <foam/report/internal/plot.hpp>

namespace foam::inline report::plot {

struct Tick {
    double value = 0;
    std::string label; ///< empty: a tick between labelled ones
};

struct Scale {
    bool logarithmic = false;
    double low = 0, high = 1;
    std::vector<Tick> ticks;

    /// 0 at the low end, 1 at the high one.
    double position(double value) const;
    /// Whether it can be drawn.
    bool holds(double value) const;
};

/// A scale over the values that can be drawn, its ends on ticks. A linear one begins at 0 unless a value is below.
Scale scale_over(const Axis& axis, const std::vector<double>& values);

/// "0.01", "500", "20k", "1M".
std::string tick_label(double value);

} // namespace foam::report::plot
