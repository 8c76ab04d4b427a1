// The figure's geometry in pixels, after the camera's projection.
#pragma once

#include "layout.hpp"

#include <foam/geometry/figure.hpp>
#include <foam/sdk/context.hpp>

#include <vector>

namespace foam::snapshot {

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
