// What is to be drawn, in pixels: the figure's geometry after the camera.
#pragma once

#include "layout.hpp"

#include <foam/context.hpp>
#include <foam/figure.hpp>

#include <vector>

namespace foam::snapshot {

/// A corner of a facet, ready for the graphics pipeline.
struct Corner {
    float position[3]; ///< pixels from the middle of the view: right, up, towards the eye
    float normal[3];   ///< unit, of the facet; in the same axes
};

/// A ball, ready for the graphics pipeline.
struct Ball {
    float center[3]; ///< pixels, as above
    float radius;    ///< pixels
    float colour[3]; ///< red, green, blue, 0 to 1
    float identity;  ///< 1 to 250: tells neighbours apart for outlines
};

/// The geometry of one panel.
struct View {
    float middle[2];            ///< of the view in the picture, pixels from the lower left corner
    std::vector<Corner> facets; ///< three a triangle, opaque
    std::vector<Corner> glass;  ///< three a triangle, translucent
    std::vector<Ball> balls;
};

struct Scene {
    int width = 0, height = 0; ///< pixels
    float depth = 1;           ///< all geometry is within ± depth of the middle, pixels
    std::vector<View> views;
};

/// Triangles and spheres with values that are not finite are left out, with a warning.
Scene make_scene(const Figure& figure, const Layout& layout, Context& context);

} // namespace foam::snapshot
