// Grids of parallel lines, and where they cross a mesh.
#pragma once

#include "geometry/line_crossing.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace foam::geometry {

class MeshPart;

/// Lines parallel to an axis, one through each cell of a grid over a box, at a place in the cell that is the same every
/// time.
struct LineGrid {
    LineGrid(const Box& bounds, int parallel_to, std::size_t lines_a_side, std::string_view stream);

    /// Of the cell across the lines.
    double cell_area() const;

    Box box;
    int axis;
    std::size_t across;      ///< cells a side
    std::vector<Line> lines; ///< row by row; a row is one cell wide along the axis after `axis`
};

/// Crossings of a grid's lines with a mesh and what closes it: of each line as MeshPart::crossings() has them. They are
/// found triangle by triangle: a triangle meets few lines.
class GridCrossings {
public:
    GridCrossings() = default;
    GridCrossings(const MeshPart& part, const LineGrid& grid);

    std::span<const Crossing> of(std::size_t line) const {
        return std::span(crossings_).subspan(begins_[line], begins_[line + 1] - begins_[line]);
    }

private:
    std::vector<Crossing> crossings_;
    std::vector<std::size_t> begins_; ///< of each line, and the end
};

} // namespace foam::geometry
