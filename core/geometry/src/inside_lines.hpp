// The parts of a fixed grid of lines inside a solid.
#pragma once

#include "intervals.hpp"

#include <foam/geometry/internal/estimate.hpp>

namespace foam::inline geometry {

struct SolidData;

/// The parts of lines inside a solid: parallel to each axis, one line through each cell of a grid over the solid's box,
/// at a fixed place in the cell.
class InsideLines {
public:
    explicit InsideLines(const SolidData& data);

    /// Volume of the solid, m³.
    Estimate volume() const { return volume_; }
    /// Returns the volume of the solid outside the spheres, m³.
    double outside(std::span<const Sphere> spheres) const;

private:
    struct Row {
        std::vector<Vec3> origins;
        std::vector<std::size_t> ends; ///< end of each line's intervals in `inside`
        Intervals inside;              ///< relative to the line's origin
    };

    Box box_;
    std::size_t across_;    ///< lines per side of a grid
    std::vector<Row> rows_; ///< those of the first axis, of the second, of the third
    Estimate volume_;
};

} // namespace foam::geometry
