// Small pictures of spheres.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <span>
#include <string>

namespace foam::inline batch {

/// Returns an SVG element that shows the spheres from an oblique direction, the z axis up: shaded discs, the nearest
/// last. "" without spheres. The sizes of pictures cannot be compared: each fills its frame.
std::string thumbnail_svg(std::span<const Sphere> spheres);

/// Returns the SVG element with the shading that all thumbnails of a page use.
std::string thumbnail_shading();

} // namespace foam::batch
