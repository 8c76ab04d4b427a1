// The length of (x, y), with the same bits everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam {

/// Returns √(x² + y²), wrong by less than one unit in the last place; inf if one is infinite, else NaN if one is. The C
/// library's function differs between versions, and with it the results of a search. Source: C. F. Borges, "An Improved
/// Algorithm for hypot(a,b)", 2019, arXiv:1904.09481, the corrected algorithm without fused multiply-add.
inline double hypot(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
        return std::isinf(x) || std::isinf(y) ? std::numeric_limits<double>::infinity() : x + y;
    }
    double a = std::max(std::abs(x), std::abs(y)), b = std::min(std::abs(x), std::abs(y));
    if (b <= a * 0x1p-54) { // less than half a unit of a
        return a + b;
    }
    // The squares neither overflow nor lose bits: exact powers of two.
    const double scale = a > 0x1p511 ? 0x1p600 : b < 0x1p-459 ? 0x1p-600 : 1;
    a /= scale;
    b /= scale;
    const double h = std::sqrt(a * a + b * b);
    double error; // h² - a² - b², in an order of which each step is exact or small
    if (h <= 2 * b) {
        const double delta = h - b;
        error = a * (2 * delta - a) + (delta - 2 * (a - b)) * delta;
    } else {
        const double delta = h - a;
        error = 2 * delta * (a - 2 * b) + ((4 * delta - b) * b + delta * delta);
    }
    return (h - error / (2 * h)) * scale; // a step of Newton
}

} // namespace foam
