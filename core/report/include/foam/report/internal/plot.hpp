// Line plots as SVG files: for the pages, in light and dark.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {
namespace plot {

struct Axis {
    std::string label; ///< with the unit
    bool logarithmic = false;
    std::vector<double> ticks; ///< values to be labelled, ascending; empty: round ones
};

struct Series {
    std::string label; ///< series of one label in several panels share their look and their line in the legend
    std::vector<std::pair<double, double>> points; ///< in the order of the line; on a logarithmic axis values that are
                                                   ///< not above 0 are left out, and so is what is not finite
    bool reference = false;                        ///< of another program: grey and dashed
};

struct Panel {
    std::string title; ///< may be empty
    std::vector<Series> series;
};

/// Panels side by side that share both axes, and a legend.
struct Plot {
    std::string title;
    Axis x, y;
    std::vector<Panel> panels;
};

/// A whole SVG 1.1 file that needs no other: equal plots give equal bytes. Its colours follow the reader's light or
/// dark scheme and are told apart by those who see few of them; markers differ, too.
std::string to_svg(const Plot& plot);

} // namespace plot
} // namespace report
} // namespace foam
