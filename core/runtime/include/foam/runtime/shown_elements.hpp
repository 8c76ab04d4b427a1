// Elements of any kind in pictures.
#pragma once

#include <foam/geometry/figure.hpp>
#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Adds elements to a view, at the pose of their link: spheres as spheres, others as meshes around them.
void add_elements(Panel& panel, const Elements& elements, const Pose& pose);

} // namespace runtime
} // namespace foam
