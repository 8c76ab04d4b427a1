// How a time grows with the size of the work.
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace foam::inline bench::experiment {

/// y = factor · x^exponent.
struct PowerLaw {
    double factor = 0, exponent = 0;
    double from = 0, to = 0; ///< the range of x that was fitted
};

/// Fitted by least squares to the logarithms of the points in the upper range: those with x of at least a tenth of the
/// largest, where constant costs no longer count. Nothing for fewer than three points there. Points that are not above
/// 0 count as absent.
std::optional<PowerLaw> fitted_power_law(const std::vector<std::pair<double, double>>& points);

} // namespace foam::bench::experiment
