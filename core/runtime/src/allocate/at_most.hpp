// The spheres of one shape with a fixed count, such that a larger count never increases the excess volume.
#pragma once

#include "input/shapes.hpp"

namespace foam::inline runtime {

/// Finds the best tree with at most `most` spheres and returns its count, under which ShapeWork::trees has it. The
/// spherizer is called with counts_alone(), and with 12, 24 and 48 where these may be better. With guarantee outer the
/// excess volume never rises with `most` up to 64, whatever the spherizer: the best tree of a count is refined with the
/// numbers of spheres up to the next count, and each of them is measured. Above 64 it is never larger than for 64.
/// Trees with levels between root and finest level get no more spheres. With such trees, with the other guarantees and
/// with half-space constraints the spherizer is also called with `most` itself, and the best tree of all is taken.
std::size_t best_of_at_most(const Workspace& workspace, ShapeWork& work, std::size_t most);

} // namespace foam::runtime
