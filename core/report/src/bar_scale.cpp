#include <foam/report/bar_scale.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline report {

namespace {

constexpr double linear_span = 30; ///< shorter bars cannot be told apart

} // namespace

BarScale::BarScale(const std::vector<double>& numbers, double least_shown, bool always_linear)
    : least_shown_(least_shown) {
    double least = std::numeric_limits<double>::infinity();
    for (const double number : numbers) {
        if (std::isfinite(number) && number > 0 && number >= least_shown) {
            least = std::min(least, number);
            greatest_ = std::max(greatest_, number);
        }
    }
    if (!always_linear && greatest_ > linear_span * least) {
        lowest_ = std::pow(10, std::ceil(std::log10(least)) - 1);
    }
}

double BarScale::share(double number) const {
    if (empty() || !(number > 0) || number < least_shown_) {
        return 0;
    }
    const double share =
        logarithmic() ? std::log(number / lowest_) / std::log(greatest_ / lowest_) : number / greatest_;
    return std::clamp(share, 0.0, 1.0);
}

std::string BarScale::svg(double number) const {
    const double length = share(number);
    return length > 0 ? fmt::format("<svg class=\"bar\" viewBox=\"0 0 100 4\" preserveAspectRatio=\"none\" "
                                    "aria-hidden=\"true\"><rect width=\"{:.1f}\" height=\"4\"/></svg>",
                                    100 * length)
                      : "";
}

} // namespace foam::report
