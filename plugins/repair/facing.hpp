// The orientation of patches of an open or branching mesh.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <cstddef>

namespace foam::repair {

struct FacingReport {
    std::size_t turned = 0; ///< triangles
    std::size_t walls = 0;  ///< removed triangles with the inside on both sides
};

/// Turns patches (triangles connected over edges of two) so that the outside, by generalised winding number, is in
/// front of them. Removes patches with the inside on both sides: walls between touching bodies.
FacingReport face_outwards(Mesh& mesh, Context& context);

} // namespace foam::repair
