// Numbers as programs hold them that read files in single precision.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the number, rounded to single precision. By way of memory: g++ 12 leaves the conversions of neighbouring numbers out where it turns them
/// into vectors (-O2; std::transform over three doubles a vertex).
inline double in_single_precision(double value) {
    const volatile float rounded = static_cast<float>(value);
    return static_cast<double>(rounded);
}

/// Returns the vector with its numbers in single precision.
inline Vec3 in_single_precision(const Vec3& v) {
    return {in_single_precision(v.x), in_single_precision(v.y), in_single_precision(v.z)};
}

} // namespace geometry
} // namespace foam
