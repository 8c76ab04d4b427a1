// What is painted: the scene, where its parts lie, from where it is seen, its colours.
#pragma once

#include <foam/geometry/figure.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

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

/// Red, green, blue, 0 to 255.
using Colour = std::array<unsigned char, 3>;

/// Returns Viridis (van der Walt and Smith 2015, "A better default colormap for Matplotlib"): perceptually uniform,
/// readable in grey and for colour-blind eyes; 256 entries.
const std::array<Colour, 256>& viridis();

/// Returns the entry for `value` within [low, high]; the middle one if the range is empty.
Colour colour_of(double value, double low, double high);

/// A corner of a facet, for the graphics pipeline.
struct Corner {
    float position[3]; ///< pixels from the middle of the view: right, up, towards the eye
    float normal[3];   ///< unit, of the facet; in the same axes
    float colour[3];   ///< red, green, blue, 0 to 1
    float edges;       ///< 1: the edges are drawn; 0: they are not
};

/// A ball, for the graphics pipeline.
struct Ball {
    float center[3]; ///< pixels, as above
    float radius;    ///< pixels
    float colour[3]; ///< red, green, blue, 0 to 1
    float identity;  ///< 1 to 250: distinguishes neighbours for outlines
};

/// The geometry of one panel.
struct View {
    float middle[2];            ///< of the view in the picture, pixels from the lower left corner
    std::vector<Corner> facets; ///< three per triangle, opaque
    std::vector<Corner> glass;  ///< three per triangle, translucent
    std::vector<Ball> balls;
};

struct Scene {
    int width = 0, height = 0; ///< pixels
    float depth = 1;           ///< all geometry is within ± depth of the middle, pixels
    std::vector<View> views;
};

/// A part of the picture, pixels from its lower left corner.
struct Drawn {
    int left = 0, bottom = 0, width = 0, height = 0;
};

/// Returns the part of the picture that the view's geometry and its outlines take; of no size if there is none.
Drawn drawn(const Scene& scene, const View& view);

/// Returns the scene. Leaves out triangles and spheres with values that are not finite, with a warning.
Scene make_scene(const Figure& figure, const Layout& layout, Context& context);

} // namespace foam::snapshot
