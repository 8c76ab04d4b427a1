// Elements of any kind in pictures and beside planes.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Adds elements to a view, at the pose of their link: spheres as spheres, others as meshes around them.
void add_elements(Panel& panel, const ElementsView& elements, const Pose& pose);

/// Returns what reached() of clip_plane.hpp does, for elements of any kind.
std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, const ElementsView& elements);

} // namespace runtime
} // namespace foam
