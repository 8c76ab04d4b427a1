// A piece of a scene, read once and placed wherever a node shows it.
#pragma once

#include "affine.hpp"
#include "builder.hpp"

#include <functional>

namespace foam::load_mesh {

/// Polygons over points of their own, in the frame of the piece. Points that no face uses need not be finite.
struct Part {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners; ///< polygon after polygon; in range
    std::vector<std::uint32_t> sizes;   ///< corners of each polygon, at least 3
    /// The error that `what` is wrong with point i; names its place in the file.
    std::function<Error(std::size_t i, const std::string& what)> error;
};

/// Without the points that no face uses, so that placing it costs no more than its faces. Errors keep the numbers of
/// the points in the file.
Part compacted(Part part);

/// Adds the polygons at `pose`, turned round where it mirrors, so that the outside stays outside. Throws part.error()
/// for a used point that is not finite.
void place(const Part& part, const Affine& pose, MeshBuilder& builder);

} // namespace foam::load_mesh
