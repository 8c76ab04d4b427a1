#pragma once

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A quantity and its standard error.
struct Estimate {
    double value = 0, error = 0;
};

} // namespace geometry
} // namespace foam
