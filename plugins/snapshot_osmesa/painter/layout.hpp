// The layout of the picture.
#pragma once

#include "camera.hpp"

#include <foam/geometry/figure.hpp>

#include <optional>
#include <vector>

namespace foam::snapshot {

/// A rectangle of the picture, pixels from the upper left corner.
struct Rectangle {
    double left = 0, top = 0, width = 0, height = 0;
};

/// The smallest and largest radius of all drawable spheres, metres.
struct RadiusRange {
    double least = 0, most = 0;
};

struct Layout {
    Camera camera;
    int width = 0, height = 0; ///< pixels of the whole picture
    double unit = 1;           ///< pixels; 1 in a picture of 1280 × 960, all texts and margins are multiples of it
    double scale = 1;          ///< pixels per metre, the same in all panels
    double title_height = 0;   ///< pixels at the top
    struct Cell {
        Rectangle view; ///< the panel's picture
        Vec3 middle;    ///< of the panel's content along the camera's axes, metres
        double caption_top = 0, caption_left = 0, caption_width = 0;
    };
    std::vector<Cell> cells; ///< one per panel
    std::optional<Rectangle> colour_bar;
    RadiusRange radii;
};

/// Returns the layout. `turntable`: the same scale and places from every azimuth.
Layout arrange(const Figure& figure, const Camera& camera, bool turntable);

/// Returns whether a point, a sphere can be drawn: finite and within the drawable range, the radius positive.
bool drawable(const Vec3& point);
bool drawable(const Sphere& sphere);

} // namespace foam::snapshot
