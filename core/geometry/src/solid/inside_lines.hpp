// The parts of a fixed grid of lines inside a solid.
#pragma once

#include "solid/intervals.hpp"

#include <foam/geometry/internal/measure_parts.hpp>

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

    // The lines one by one. A row is one cell wide along the axis after its lines' own.
    std::size_t rows() const { return rows_.size(); }
    /// Returns the lines of a row.
    std::size_t across() const { return across_; }
    /// Returns the volume of the solid for a unit of length along a line, m².
    double share(std::size_t row) const;
    /// Returns whether a ball reaches the row.
    bool reaches(std::size_t row, const Sphere& ball) const;
    /// Returns in `result` those of the balls that reach the row.
    void balls_at(std::size_t row, std::span<const Sphere> balls, std::vector<Sphere>& result) const;
    /// Returns whether the line meets one of the balls.
    bool meets_any(std::size_t row, std::size_t line, std::span<const Sphere> balls) const;
    /// Returns a point of the line, and its parts inside the solid relative to that point.
    const Vec3& origin(std::size_t row, std::size_t line) const { return rows_[row].origins[line]; }
    std::span<const Solid::Interval> inside(std::size_t row, std::size_t line) const {
        const std::size_t begin = line == 0 ? 0 : rows_[row].ends[line - 1];
        return std::span(rows_[row].inside).subspan(begin, rows_[row].ends[line] - begin);
    }
    /// Returns the axis that the lines of a row are parallel to.
    int axis(std::size_t row) const { return axis_of(row); }
    /// Returns the least length of a piece that counts, m.
    double shortest() const;
    struct Scratch {
        Intervals in_balls, pieces;
    };
    /// Returns the length of the line inside the solid and outside the balls, m. Balls that do not meet the line change
    /// nothing.
    double length_outside(std::size_t row, std::size_t line, std::span<const Sphere> balls, Scratch& scratch) const;

private:
    int axis_of(std::size_t row) const { return static_cast<int>(row / across_); }

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

/// Returns the lines of a solid, computed on first use. Safe from any number of threads.
const InsideLines& inside_lines(const Solid& solid);

} // namespace foam::inline geometry
