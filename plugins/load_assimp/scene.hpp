// The conversion of assimp's scene to a Mesh. Nothing in the scene is trusted.
#pragma once

#include "affine.hpp"

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <assimp/scene.h>

#include <stdexcept>

namespace foam::load_assimp {

/// The error in a scene, and the remedy; without the file's name.
class BadScene : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Returns whether there are polygons to cut into triangles. Throws BadScene unless all faces refer to existing
/// vertices and give at most `max_triangles`. Must run before any other step of assimp reads the faces.
bool check_faces(const aiScene& scene, std::size_t max_triangles);

/// Returns the triangles of all nodes, placed by `frame` and their nodes; equal vertices become one. Leaves out
/// triangles with two equal corners, lines and points, with a note. Throws BadScene.
Mesh mesh_of(const aiScene& scene, const Affine& frame, std::size_t max_triangles, Context& context);

} // namespace foam::load_assimp
