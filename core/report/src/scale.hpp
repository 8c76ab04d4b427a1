// Where a value lies on an axis, and which values are labelled.
#pragma once

#include <string>
#include <vector>

namespace foam::inline report::plot {

struct Tick {
    double value = 0;
    std::string label;
};

struct Scale {
    double low = 0, high = 1;
    std::vector<Tick> ticks;

    /// Returns 0 at the low end, 1 at the high one.
    double position(double value) const { return (value - low) / (high - low); }
};

/// Returns a scale over the values that are finite, its ends on ticks. It begins at 0 unless a value is below.
Scale scale_over(const std::vector<double>& values);

/// Returns "0.01", "500", "20k", "1M".
std::string tick_label(double value);

} // namespace foam::inline report::plot
