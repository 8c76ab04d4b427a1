// The elements of shapes as they cover, for what looks at them before the run is finished.
#pragma once

#include "input/shapes.hpp"

#include <map>
#include <utility>
#include <vector>

namespace foam::inline runtime {

/// Grows each known tree once, where the guarantee is that it covers. Not thread-safe.
class CoveringElements {
public:
    CoveringElements(const Workspace& workspace, const std::vector<ShapeWork>& shapes)
        : workspace_(workspace), shapes_(shapes) {}

    /// Returns the finest level of a known tree of the group's shape, in the frame of its link.
    Elements of(const Group& group, std::size_t count);

private:
    const Elements& of_shape(std::size_t shape, std::size_t count);

    const Workspace& workspace_;
    const std::vector<ShapeWork>& shapes_;
    std::map<std::pair<std::size_t, std::size_t>, Elements> known_; ///< by shape and count
};

} // namespace foam::runtime
