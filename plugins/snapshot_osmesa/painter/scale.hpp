// Round numbers for an axis of lengths.
#pragma once

#include <string>
#include <vector>

namespace foam::snapshot {

/// A mark on the bar.
struct Tick {
    double value;      ///< metres
    std::string label; ///< in the scale's unit
};

struct Scale {
    std::string unit; ///< "m", "mm", …
    std::vector<Tick> ticks;
};

/// Returns round values between `least` and `most` (Heckbert 1990, "Nice numbers for graph labels") in a suitable unit;
/// one value if both are equal. Precondition: 0 < least <= most.
Scale make_scale(double least, double most);

} // namespace foam::snapshot
