// The picture that a renderer draws.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A mesh in a picture.
struct FigureMesh {
    std::shared_ptr<const Mesh> mesh;
    Pose pose;                ///< from the mesh's frame to the panel's
    bool translucent = false; ///< drawn over the spheres, which stay visible
    /// Colours 0xRRGGBBAA of each triangle, of which 0 and missing ones are grey; where there are any, edges are not
    /// drawn. Opaque meshes only; AA is not looked at.
    std::vector<std::uint32_t> colours{};
};

/// One view: meshes and spheres in one frame (z up), seen from a fixed direction, scaled to the panel.
struct Panel {
    std::string caption; ///< below the view; may be empty
    std::vector<FigureMesh> meshes;
    std::vector<Sphere> spheres; ///< coloured by radius
};

/// A picture of one or more panels side by side, all at the same scale and from the same direction.
struct Figure {
    std::string title; ///< may be empty
    std::vector<Panel> panels;
    int width = 1280, height = 960; ///< pixels of the whole picture
    bool colour_bar = true;         ///< a labelled bar of the radii, if there are spheres
};

/// An encoded picture.
struct Image {
    int width = 0, height = 0;
    std::string png;
};

} // namespace geometry
} // namespace foam
