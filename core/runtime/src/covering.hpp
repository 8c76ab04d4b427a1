// The elements of shapes as they cover, for what looks at them before the run is finished.
#pragma once

#include "shapes.hpp"

#include <map>
#include <utility>
#include <vector>

namespace foam::inline runtime {

/// Grows each known tree once, where the guarantee is that it covers. Not thread-safe.
class CoveringElements {
public:
    CoveringElements(const Workspace& workspace, const std::vector<ShapeWork>& shapes)
        : workspace_(workspace), shapes_(shapes) {}

    /// Returns the finest level of a known tree, in the shape's frame.
    const Approximation::Level& of(std::size_t shape, std::size_t count);

private:
    const Workspace& workspace_;
    const std::vector<ShapeWork>& shapes_;
    std::map<std::pair<std::size_t, std::size_t>, Approximation::Level> known_; ///< by shape and count
};

} // namespace foam::runtime
