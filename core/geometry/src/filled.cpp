#include <foam/geometry/internal/filled.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/directions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace foam::inline geometry {
namespace {

constexpr std::size_t cells_along = 48, lines = 16;

/// A grid of cubes around a solid.
class CellGrid {
public:
    explicit CellGrid(const Solid& solid) : origin_(solid.bounds().low) {
        const Vec3 size = solid.bounds().size();
        cell_ = std::max({size.x, size.y, size.z}) / cells_along;
        for (int axis = 0; axis < 3 && cell_ > 0; ++axis) {
            count_[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(size[axis] / cell_)));
        }
    }

    using Cell = std::array<std::size_t, 3>;
    std::size_t size() const { return count_[0] * count_[1] * count_[2]; }
    /// Returns the number of cells along an axis.
    std::size_t along(int axis) const { return count_[axis]; }
    /// Returns how far apart the indices of neighbours along an axis are.
    std::size_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? count_[0] : count_[0] * count_[1]; }
    Cell cell(std::size_t i) const { return {i % count_[0], i / count_[0] % count_[1], i / (count_[0] * count_[1])}; }
    std::size_t index(const Cell& cell) const { return (cell[2] * count_[1] + cell[1]) * count_[0] + cell[0]; }
    /// Returns the index of the neighbour along an axis; nothing at the end of the grid.
    std::optional<std::size_t> neighbour(const Cell& cell, int axis, int step) const {
        if ((step < 0 && cell[axis] == 0) || (step > 0 && cell[axis] + 1 == count_[axis])) {
            return {};
        }
        Cell other = cell;
        other[axis] += static_cast<std::size_t>(step);
        return index(other);
    }
    Vec3 corner(const Cell& at) const {
        return origin_ +
               Vec3{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])} * cell_;
    }
    /// Returns the index of a corner: corners are one more along each axis.
    std::size_t corner_index(const Cell& at) const {
        return (at[2] * (count_[1] + 1) + at[1]) * (count_[0] + 1) + at[0];
    }
    std::size_t corners() const { return (count_[0] + 1) * (count_[1] + 1) * (count_[2] + 1); }
    Vec3 centre(const Cell& at) const { return corner(at) + Vec3{cell_, cell_, cell_} * 0.5; }
    double edge() const { return cell_; }
    /// Returns the radius of the sphere around a cell.
    double radius() const { return std::sqrt(0.75) * cell_; }

private:
    Vec3 origin_;
    double cell_ = 0;
    Cell count_{}; ///< zero for a solid that is a point
};

/// Marks the cells in which the solid meets the line through their centres along an axis.
void mark_row(const Solid& solid, const CellGrid& grid, CellGrid::Cell first, int axis, std::vector<char>& marked) {
    constexpr double rounding = 1e-6; // of a cell: a wall that ends between two cells is in one of them
    first[axis] = 0;
    Vec3 start = grid.centre(first), direction{};
    start[axis] = grid.corner(first)[axis];
    direction[axis] = 1;
    const std::size_t begin = grid.index(first), stride = grid.stride(axis);
    const auto last = static_cast<double>(grid.along(axis) - 1);
    for (const Solid::Interval& inside : solid.inside_along(start, direction)) {
        const double enter = inside.enter / grid.edge(), leave = inside.leave / grid.edge();
        const double inset = std::min(rounding, (leave - enter) / 2);
        const auto from = static_cast<std::size_t>(std::clamp(std::floor(enter + inset), 0.0, last));
        const auto to = static_cast<std::size_t>(std::clamp(std::floor(leave - inset), 0.0, last));
        for (std::size_t k = from; k <= to; ++k) {
            marked[begin + k * stride] = 1;
        }
    }
}

/// Returns which cells the solid meets along the three lines through their centres. Walls of any thickness count: no
/// walk over faces of cells gets through one (6-separating; Laine 2013, "A Topological Approach to Voxelization").
std::vector<char> solid_cells(const Solid& solid, const CellGrid& grid) {
    std::vector<char> marked(grid.size(), 0);
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        parallel_for(grid.along(u) * grid.along(v), [&](std::size_t row) {
            CellGrid::Cell first{};
            first[u] = row % grid.along(u);
            first[v] = row / grid.along(u);
            mark_row(solid, grid, first, axis, marked);
        });
    }
    return marked;
}

/// The cells that a line meets, in order (Amanatides and Woo 1987), relative to the cell in whose centre it begins. The
/// lines that begin in the centres of the other cells of a layer meet the same cells, shifted: each cell of the grid is
/// the middle of its layer for one of these lines, which passes its centre by half a cell at most.
class LineOfCells {
public:
    struct Step {
        std::array<std::ptrdiff_t, 3> cell;
        bool middle; ///< the line is there halfway through the layer
    };

    LineOfCells(Vec3 direction, const CellGrid& grid) {
        for (int axis = 1; axis < 3; ++axis) {
            if (std::abs(direction[axis]) > std::abs(direction[axis_])) {
                axis_ = axis;
            }
        }
        direction = direction * (1 / direction[axis_]);
        Step at{{}, true};
        const auto layers = static_cast<std::ptrdiff_t>(grid.along(axis_));
        while (at.cell[axis_] < layers) {
            steps_.push_back(at);
            append_way(direction, at);
        }
    }

    /// The axis across layers.
    int axis() const { return axis_; }
    const std::vector<Step>& steps() const { return steps_; }

private:
    /// Appends what lies between the middles of two layers; `at` becomes the second one.
    void append_way(const Vec3& direction, Step& at) {
        const auto layer = static_cast<double>(at.cell[axis_]);
        std::array<std::pair<double, int>, 3> changes; // where the line leaves the cell, and along which axis
        std::size_t count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double from = std::floor(direction[axis] * layer + 0.5);
            const double to = std::floor(direction[axis] * (layer + 1) + 0.5);
            if (from != to) {
                changes[count++] = {(std::max(from, to) - 0.5) / direction[axis], axis};
            }
        }
        std::sort(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(count));
        for (std::size_t i = 0; i < count; ++i) {
            at.cell[changes[i].second] += direction[changes[i].second] > 0 ? 1 : -1;
            at.middle = i + 1 == count;
            if (!at.middle) {
                steps_.push_back(at);
            }
        }
    }

    int axis_ = 0;
    std::vector<Step> steps_;
};

/// The lines of one direction through a grid.
class LineBundle {
public:
    LineBundle(const CellGrid& grid, const Vec3& direction) : grid_(grid), line_(direction, grid) {}

    /// Returns which cells have marked ones on both sides along their lines.
    std::vector<char> between(const std::vector<char>& marked) const {
        std::vector<char> result(grid_.size(), 0);
        const int u = (line_.axis() + 1) % 3, v = (line_.axis() + 2) % 3;
        const auto [u_from, u_to] = starts(u);
        const auto [v_from, v_to] = starts(v);
        std::array<std::ptrdiff_t, 3> start{};
        std::vector<On> on;
        for (start[v] = v_from; start[v] < v_to; ++start[v]) {
            check_cancelled();
            for (start[u] = u_from; start[u] < u_to; ++start[u]) {
                cells_of(start, on);
                mark_between(on, marked, result);
            }
        }
        return result;
    }

private:
    struct On {
        std::size_t cell;
        bool middle;
    };

    /// Returns where lines begin along an axis so that they meet every cell.
    std::pair<std::ptrdiff_t, std::ptrdiff_t> starts(int axis) const {
        std::ptrdiff_t least = 0, most = 0;
        for (const LineOfCells::Step& step : line_.steps()) {
            least = std::min(least, step.cell[axis]);
            most = std::max(most, step.cell[axis]);
        }
        return {-most, static_cast<std::ptrdiff_t>(grid_.along(axis)) - least};
    }
    void cells_of(const std::array<std::ptrdiff_t, 3>& start, std::vector<On>& on) const {
        on.clear();
        for (const LineOfCells::Step& step : line_.steps()) {
            CellGrid::Cell cell;
            bool within = true;
            for (int axis = 0; axis < 3; ++axis) {
                cell[axis] = static_cast<std::size_t>(start[axis] + step.cell[axis]); // negative ones become large
                within = within && cell[axis] < grid_.along(axis);
            }
            if (within) {
                on.push_back({grid_.index(cell), step.middle});
            }
        }
    }
    static void mark_between(const std::vector<On>& on, const std::vector<char>& marked, std::vector<char>& result) {
        const auto is_marked = [&](const On& at) { return marked[at.cell] != 0; };
        const auto first = std::find_if(on.begin(), on.end(), is_marked);
        const auto last = std::find_if(on.rbegin(), std::make_reverse_iterator(first), is_marked).base();
        for (auto at = first; at != last; ++at) {
            result[at->cell] |= at->middle ? 1 : 0;
        }
    }

    const CellGrid& grid_;
    LineOfCells line_;
};

/// Returns half of the directions of a sphere: lines have two.
std::vector<Vec3> directions_of_lines() {
    std::vector<Vec3> directions = fibonacci_directions(2 * lines);
    directions.resize(lines); // one hemisphere, as they are ordered by height
    return directions;
}

/// Returns the cells without a mark most of whose lines meet marked cells on both sides.
std::vector<char> enclosed_cells(const CellGrid& grid, const std::vector<char>& marked) {
    const std::vector<Vec3> directions = directions_of_lines();
    std::vector<std::vector<char>> between(directions.size());
    parallel_for(directions.size(),
                 [&](std::size_t i) { between[i] = LineBundle(grid, directions[i]).between(marked); });
    std::vector<char> enclosed(grid.size(), 0);
    for (std::size_t i = 0; i < enclosed.size(); ++i) {
        const auto count = static_cast<std::size_t>(
            std::count_if(between.begin(), between.end(), [&](const auto& cells) { return cells[i] != 0; }));
        enclosed[i] = !marked[i] && 2 * count > directions.size() ? 1 : 0;
    }
    return enclosed;
}

/// Leaves only the cells that the solid does not come into.
void keep_clear_cells(const Solid& solid, const CellGrid& grid, std::vector<char>& cells) {
    const std::size_t length = grid.along(0);
    parallel_for(grid.size() / length, [&](std::size_t row) {
        double least = 0; // bound on the distance: it changes by one edge at most from cell to cell
        for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
            least -= grid.edge();
            if (cells[i] && least <= grid.radius()) {
                check_cancelled();
                least = solid.signed_distance(grid.centre(grid.cell(i)));
                cells[i] = least > grid.radius() ? 1 : 0;
            }
        }
    });
}

/// Returns the closed surface of the cells, outwards.
Mesh surface_of_cells(const CellGrid& grid, const std::vector<char>& cells) {
    Mesh mesh;
    constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> known(grid.corners(), unknown);
    const auto vertex = [&](const CellGrid::Cell& at) {
        std::uint32_t& name = known[grid.corner_index(at)];
        if (name == unknown) {
            name = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(grid.corner(at));
        }
        return name;
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (int side = 0; cells[i] && side < 6; ++side) {
            const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
            const bool far = side % 2 == 1;
            const CellGrid::Cell cell = grid.cell(i);
            if (const auto next = grid.neighbour(cell, axis, far ? 1 : -1); next && cells[*next]) {
                continue;
            }
            CellGrid::Cell a = cell;
            a[axis] += far ? 1 : 0;
            CellGrid::Cell b = a, c = a, d = a;
            ++b[u];
            ++c[u];
            ++c[v];
            ++d[v];
            const std::array<std::uint32_t, 4> q{vertex(a), vertex(far ? b : d), vertex(c), vertex(far ? d : b)};
            mesh.triangles.push_back({q[0], q[1], q[2]});
            mesh.triangles.push_back({q[0], q[2], q[3]});
        }
    }
    return mesh;
}

} // namespace

std::shared_ptr<const Solid> filled(const std::shared_ptr<const Solid>& solid) {
    const CellGrid grid(*solid);
    if (grid.size() == 0) {
        return solid;
    }
    std::vector<char> cells = enclosed_cells(grid, solid_cells(*solid, grid));
    keep_clear_cells(*solid, grid, cells);
    Mesh inside = surface_of_cells(grid, cells);
    if (inside.triangles.empty()) {
        return solid;
    }
    std::vector<Solid::Part> parts = solid->parts();
    parts.push_back({std::make_shared<const Mesh>(std::move(inside)), {}, {}});
    return Solid::make(std::move(parts));
}

} // namespace foam::inline geometry
