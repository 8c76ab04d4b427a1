// Primitives that MuJoCo fits to meshes.
#pragma once

#include <foam/base/error.hpp>
#include <foam/geometry/element.hpp>
#include <foam/geometry/mesh.hpp>

#include <string_view>

namespace foam::mjcf {

struct Fit {
    Element::Kind kind = Element::Kind::sphere;
    std::string_view inertia = "legacy"; ///< of the mesh: convex, exact, legacy or shell
    bool by_box = false;                 ///< fitaabb: by the box along its axes of inertia, not by its inertia
    double scale = 1;                    ///< fitscale
};

/// Returns the primitive, in the frame of the mesh. Throws Error(geometry) for a mesh without volume or area.
Element fitted(const Mesh& mesh, const Fit& fit);

} // namespace foam::mjcf
