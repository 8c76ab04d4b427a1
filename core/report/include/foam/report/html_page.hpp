// Pages of HTML, and the bars in them.
#pragma once

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {

/// Returns a self-contained HTML page that loads no other file: its security policy lets browsers run only foam's own
/// script. It has a light and a dark theme; the columns of <table class="sortable"> can be sorted. `title` is text,
/// `body` is HTML.
std::string html_page(const std::string& title, const std::string& body);

/// A scale of bars. It is linear from 0 if requested, or if the numbers span at most a factor of thirty; otherwise it
/// is logarithmic and begins at a power of ten below the smallest number.
class BarScale {
public:
    /// Ignores numbers below `least_shown` and numbers that are not finite.
    explicit BarScale(const std::vector<double>& numbers, double least_shown = 0, bool always_linear = false);

    bool empty() const { return greatest_ <= 0; } ///< nothing to compare
    bool logarithmic() const { return lowest_ > 0; }
    double lowest() const { return lowest_; } ///< where bars begin
    double greatest() const { return greatest_; }
    /// Returns the length of a number's bar, at most 1; 0 below where bars begin.
    double share(double number) const;
    /// Returns the bar as an element of HTML pages; "" if it has no length.
    std::string svg(double number) const;

private:
    double lowest_ = 0, greatest_ = 0, least_shown_ = 0;
};

} // namespace report
} // namespace foam
