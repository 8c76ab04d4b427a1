// The refinements of a shape's spheres, as its recipe lists them.
#pragma once

#include "input/shapes.hpp"

namespace foam::inline runtime {

/// Makes the refiners of a shape, whose geometry is built.
void begin_refinements(const Workspace& workspace, ShapeWork& work);

/// Returns the tree after all refinements, or after those that do not add spheres, with at most `most` spheres in the
/// finest level. Checks the result of each. Several threads may call it for one shape. After a request to stop, the
/// result so far is returned.
enum class Refiners { all, not_adding };
SphereTree refined(const Workspace& workspace, ShapeWork& work, SphereTree tree, std::size_t most, Refiners which);

/// Checks the contract of spherizers and refiners: finite spheres, valid elements of the kinds that the stage declares,
/// in proportion to the shape with these bounds, at most as many as requested and as cost what was requested, valid
/// parents. Throws Error(plugin).
void check_tree(const SphereTree& tree, const Budget& budget, const std::vector<Element::Kind>& kinds,
                const Box& bounds, std::string_view stage_kind);

} // namespace foam::inline runtime
