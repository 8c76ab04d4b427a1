// A solid along a fixed grid of lines.
#pragma once

#include "geometry/estimate.hpp"
#include "geometry/intervals.hpp"

namespace foam::geometry {

struct SolidData;

/// Where lines run inside a solid: parallel to each axis one through each cell of a grid over the solid's box, at a
/// place in the cell that is the same every time.
class InsideLines {
public:
    explicit InsideLines(const SolidData& data);

    /// Of the solid, m³.
    Estimate volume() const { return volume_; }
    /// Volume of the solid outside the spheres, m³.
    double outside(std::span<const Sphere> spheres) const;

private:
    struct Row {
        std::vector<Vec3> origins;
        std::vector<std::size_t> ends; ///< of each line in `inside`
        Intervals inside;              ///< relative to the line's origin
    };

    Box box_;
    std::size_t across_;    ///< lines a side of a grid
    std::vector<Row> rows_; ///< of the first axis, of the second, of the third
    Estimate volume_;
};

} // namespace foam::geometry
