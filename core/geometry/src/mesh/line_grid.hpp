// Grids of parallel lines, and their crossings with a mesh.
#pragma once

#include "mesh/line_crossing.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace foam::inline geometry {

class MeshPart;

/// Lines parallel to an axis, one through each cell of a grid over a box, at a fixed place in the cell.
struct LineGrid {
    LineGrid(const Box& bounds, int parallel_to, std::size_t lines_a_side, std::string_view stream);

    /// The lines that may meet a box: in each row those from `begin` to `end`, one past the last, and the rows
    /// likewise.
    struct Near {
        std::size_t first_row, last_row, begin, end;
    };
    Near near(const Box& box) const;
    /// Returns the area of a cell across the lines.
    double cell_area() const;

    Box box;
    int axis;
    std::size_t across;      ///< cells per side
    std::vector<Line> lines; ///< row by row; a row is one cell wide along the axis after `axis`
};

/// Crossings of a grid's lines with a mesh and its closing surface: for each line the same as MeshPart::crossings().
/// They are computed triangle by triangle, as a triangle meets few lines.
class GridCrossings {
public:
    GridCrossings() = default;
    GridCrossings(const MeshPart& part, const LineGrid& grid);

    /// Returns the crossings of a line; none if it misses the mesh.
    std::span<const Crossing> of(std::size_t line) const {
        if (line < first_ || line - first_ + 1 >= begins_.size()) {
            return {};
        }
        const std::size_t at = line - first_;
        return std::span(crossings_).subspan(begins_[at], begins_[at + 1] - begins_[at]);
    }

private:
    std::vector<Crossing> crossings_;
    std::size_t first_ = 0;           ///< first line that may meet the mesh
    std::vector<std::size_t> begins_; ///< start for each line from that to the last that may, and the end
};

} // namespace foam::geometry
