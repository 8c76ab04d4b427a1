// The view: a parallel projection, so that sizes are comparable over all panels.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cmath>

namespace foam::snapshot {

/// Axes of the picture in the figure's frame (z up).
struct Camera {
    Vec3 right, up, towards; ///< unit; `towards` points to the eye

    Camera(double azimuth, double elevation)
        : right{-std::sin(azimuth), std::cos(azimuth), 0}, up{-std::sin(elevation) * std::cos(azimuth),
                                                              -std::sin(elevation) * std::sin(azimuth),
                                                              std::cos(elevation)},
          towards{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                  std::sin(elevation)} {}

    /// Returns the coordinates along right, up and towards.
    Vec3 operator()(const Vec3& v) const { return {dot(right, v), dot(up, v), dot(towards, v)}; }
};

} // namespace foam::snapshot
