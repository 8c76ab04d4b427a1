// Decimal fractions for the numbers of elements.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cmath>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// A grid of decimal fractions with step 10^-digits. Its points have a short text and read back to the same bits.
class DecimalGrid {
public:
    /// Chooses a step of about a millionth of `size`.
    explicit DecimalGrid(double size) {
        const int exponent = size > 0 ? static_cast<int>(std::floor(std::log10(size))) - 6 : -9;
        // Powers of ten up to 10^22 are exact doubles; a part smaller than 10^-15 m keeps its digits.
        scale_ = exponent < -22 || exponent > 0 ? 0 : std::pow(10.0, -exponent);
    }
    /// Returns the distance of neighbouring points along an axis, m; 0: all numbers are points.
    double step() const { return scale_ == 0 ? 0 : 1 / scale_; }
    double nearest(double value) const { return scale_ == 0 ? value : std::round(value * scale_) / scale_ + 0.0; }
    Vec3 nearest(const Vec3& v) const { return {nearest(v.x), nearest(v.y), nearest(v.z)}; }
    double up(double value) const {
        if (scale_ == 0) {
            return value;
        }
        double rounded = std::ceil(value * scale_) / scale_;
        while (rounded < value) {
            rounded = (std::round(rounded * scale_) + 1) / scale_;
        }
        return rounded;
    }
    /// Returns for a nonnegative value a grid value that is not above it; 0 below the grid's step.
    double down(double value) const {
        if (scale_ == 0) {
            return value;
        }
        const double steps = std::floor(value * scale_);
        return steps / scale_ <= value ? steps / scale_ : (steps - 1) / scale_;
    }

private:
    double scale_ = 0;
};

} // namespace runtime
} // namespace foam
