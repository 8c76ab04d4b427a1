// A ball of radius 1 as triangles.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <string>

namespace foam::gltf {

/// Returns an icosahedron whose triangles were split into four `subdivisions` times, with its corners on the sphere.
Mesh unit_sphere(int subdivisions);

/// Returns the corners of a mesh in single precision, and its triangles as 32-bit numbers.
std::string corner_bytes(const Mesh& mesh);
std::string index_bytes(const Mesh& mesh);
/// Returns the corners as single precision numbers, then the indices as 16 bit numbers, both little-endian. The normal
/// of a corner is the corner itself. Precondition: at most 65536 corners.
std::string buffer_of(const Mesh& mesh);

} // namespace foam::gltf
