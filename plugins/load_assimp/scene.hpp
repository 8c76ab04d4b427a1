// From assimp's scene to a Mesh; nothing in the scene is trusted.
#pragma once

#include "affine.hpp"

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <assimp/scene.h>

#include <stdexcept>

namespace foam::load_assimp {

/// What is wrong with a scene, and the remedy; without the file's name.
class BadScene : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Whether there are polygons to cut into triangles. Throws BadScene unless all faces refer to vertices that are there,
/// and their triangles are at most `max_triangles`. Before any other step of assimp looks at them.
bool check_faces(const aiScene& scene, std::size_t max_triangles);

/// The triangles of all nodes, placed by `frame` and their nodes; equal vertices become one. What has no area because
/// corners are the same point is left out, lines and points too; a note says so. Throws BadScene.
Mesh mesh_of(const aiScene& scene, const Affine& frame, std::size_t max_triangles, Context& context);

} // namespace foam::load_assimp
