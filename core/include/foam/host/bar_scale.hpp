// Bars that compare numbers within a column of a table.
#pragma once

#include <string>
#include <vector>

namespace foam {

/// Linear from 0; unless that is asked for, logarithmic, from a power of ten below the least of them, where the numbers
/// span more than thirtyfold.
class BarScale {
public:
    /// Numbers below `least_shown` and those that are not finite do not count.
    explicit BarScale(const std::vector<double>& numbers, double least_shown = 0, bool always_linear = false);

    bool empty() const { return greatest_ <= 0; } ///< nothing to compare
    bool logarithmic() const { return lowest_ > 0; }
    double lowest() const { return lowest_; } ///< where bars begin
    double greatest() const { return greatest_; }
    /// Length of a number's bar, at most 1; 0 below where bars begin.
    double share(double number) const;
    /// The bar as an element of HTML pages; "" if it has no length.
    std::string svg(double number) const;

private:
    double lowest_ = 0, greatest_ = 0, least_shown_ = 0;
};

} // namespace foam
