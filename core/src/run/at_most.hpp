// The spheres of one shape where more of them must never claim more.
#pragma once

#include "shapes.hpp"

namespace foam {

/// At most `most` spheres for the shape: ShapeWork::trees holds them under the number that is returned. The spherizer
/// is asked for counts_alone(). With guarantee outer what the spheres claim never rises with `most`, whatever the
/// spherizer: the best at a count is gone on with, its spheres split one after another up to the next. Trees with
/// levels between root and finest are not split: of these `most` itself is asked for too, as with the other guarantees
/// and with planes to keep off, where the best of all is taken.
std::size_t best_of_at_most(const Workspace& workspace, ShapeWork& work, std::size_t most);

} // namespace foam
