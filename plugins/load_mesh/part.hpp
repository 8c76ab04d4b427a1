// A part of a scene, read once and placed for every node that shows it.
#pragma once

#include "affine.hpp"
#include "builder.hpp"

#include <functional>

namespace foam::load_mesh {

/// Polygons with points in the frame of the part. Points that no face uses need not be finite.
struct Part {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;   ///< one polygon after the other; in range
    std::vector<std::uint32_t> sizes;     ///< corners of each polygon, at least 3
    std::vector<std::uint32_t> materials; ///< of each polygon, numbers for its reader; empty: all have 0
    /// Returns the error `what` about point i, with its place in the file.
    std::function<Error(std::size_t i, const std::string& what)> error;
};

/// Returns the part without the points that no face uses, so that the time to place it depends on its faces only.
/// Errors keep the file's numbers of the points.
Part compacted(Part part);

/// Adds the polygons at `pose`, reversed where it mirrors, so that the outside stays outside. `colours`: of the
/// materials, 0xRRGGBBAA; 0, and those that it does not have: none. Throws part.error() for a used point that is not
/// finite.
void place(const Part& part, const Affine& pose, MeshBuilder& builder, std::span<const std::uint32_t> colours = {});

} // namespace foam::load_mesh
