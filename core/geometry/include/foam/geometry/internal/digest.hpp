// Digests of geometry; see foam/base/internal/digest.hpp.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/geometry/element.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

void add_to(Hasher& hasher, const Vec3& v);
void add_to(Hasher& hasher, const Pose& pose);
void add_to(Hasher& hasher, const Mesh& mesh);
/// Adds a primitive in its own frame.
void add_primitive(Hasher& hasher, const Element& primitive);
void add_to(Hasher& hasher, const Element& element);
void add_to(Hasher& hasher, const SphereTree& tree);
void add_to(Hasher& hasher, const Measures& m);

} // namespace geometry
} // namespace foam
