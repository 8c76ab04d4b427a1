#include <foam/geometry/internal/solids.hpp>

#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/vector.hpp>

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

/// A line through the centres of cells along an axis.
struct CellRow {
    CellRow(const CellGrid& grid, int axis, std::size_t number) : stride(grid.stride(axis)), length(grid.along(axis)) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        CellGrid::Cell cell{};
        cell[u] = number % grid.along(u);
        cell[v] = number / grid.along(u);
        begin = grid.index(cell);
        origin = grid.centre(cell);
        step[axis] = grid.edge();
    }
    static std::size_t count(const CellGrid& grid, int axis) {
        return grid.along((axis + 1) % 3) * grid.along((axis + 2) % 3);
    }

    std::size_t begin = 0, stride, length; ///< of its cells: their indices
    Vec3 origin, step;                     ///< the centre of the first cell, and from one to the next
};

/// Marks the cells of a row whose centres are inside. A wall between two centres is in the cell of its middle.
void mark_inside(const CellRow& row, const std::vector<Solid::Interval>& inside, std::vector<char>& marked) {
    const auto last = static_cast<double>(row.length - 1);
    for (const Solid::Interval& part : inside) {
        double from = std::ceil(part.enter), to = std::floor(part.leave);
        if (from > to) {
            from = to = std::floor((part.enter + part.leave) / 2 + 0.5);
        }
        for (double k = std::max(from, 0.0); k <= std::min(to, last); ++k) {
            marked[row.begin + static_cast<std::size_t>(k) * row.stride] = 1;
        }
    }
}

/// Returns what lies between neighbouring crossings of a row with the surfaces, and between two centres of cells.
std::vector<Solid::Interval> stretches_between_centres(const Solid& solid, const CellRow& row) {
    std::vector<double> places;
    std::vector<Crossing> crossings;
    std::vector<WindingPiece> pieces;
    const Line line(row.origin, row.step);
    SolidAccess::data(solid).for_each_along(line, [&](const PartQueries& part) {
        if (part.primitive) {
            pieces.clear();
            winding_along(part, line, {}, pieces);
            for (const WindingPiece& piece : pieces) {
                places.insert(places.end(), {piece.enter, piece.leave});
            }
            return;
        }
        part.mesh().crossings(row.origin, row.step, crossings);
        for (const Crossing& crossing : crossings) {
            places.push_back(crossing.t);
        }
    });
    std::sort(places.begin(), places.end());
    std::vector<Solid::Interval> result;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        if (places[i] < places[i + 1] && std::ceil(places[i]) > std::floor(places[i + 1])) {
            result.push_back({places[i], places[i + 1]});
        }
    }
    return result;
}

int longest_axis(const CellGrid& grid) {
    const int longest = grid.along(1) > grid.along(0) ? 1 : 0;
    return grid.along(2) > grid.along(longest) ? 2 : longest;
}

/// Returns which cells are solid on one of the three lines through their centres. Walls of any thickness count: no walk
/// from cell to cell over their faces gets through one (6-separating; Laine 2013, "A Topological Approach to
/// Voxelization"). The lines of one axis tell which centres are inside. Winding numbers of meshes with holes are
/// expensive, so those of the others tell only about the walls between centres.
std::vector<char> solid_cells(const Solid& solid, const CellGrid& grid) {
    std::vector<char> marked(grid.size(), 0);
    const int longest = longest_axis(grid);
    const bool closed = solid.closed();
    for (const int axis : {longest, (longest + 1) % 3, (longest + 2) % 3}) {
        parallel_for(CellRow::count(grid, axis), [&](std::size_t number) {
            const CellRow row(grid, axis, number);
            mark_inside(row,
                        axis == longest || closed
                            ? solid.inside_along(row.origin, row.step)
                            : solid.inside_along(row.origin, row.step, stretches_between_centres(solid, row)),
                        marked);
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
            if (at->middle) {
                result[at->cell] = 1;
            }
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
    return SolidAccess::with_part(solid, {std::make_shared<const Mesh>(std::move(inside)), {}, {}});
}

namespace {

/// A connected component of the surface.
struct Shell {
    double volume = 0, area = 0;
    Vec3 facing; ///< ∫ n: zero for a closed shell

    bool nearly_closed() const {
        constexpr double holes = 0.01; // of the area
        return norm(facing) <= holes * area;
    }
};

} // namespace

double cavity_volume(const Solid& solid) {
    if (solid.parts().size() != 1 || solid.parts().front().primitive) {
        return 0;
    }
    const Mesh& mesh = solid.surface(); // wound outwards, but for the shells of cavities
    const std::vector<std::uint32_t> corner = welded_indices(mesh);
    DisjointSets sets(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        sets.unite(corner[a], corner[b]);
        sets.unite(corner[a], corner[c]);
    }
    const Vec3 center = solid.bounds().center();
    std::vector<Shell> shells(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        Shell& shell = shells[sets.find(corner[a])];
        const Vec3 p = mesh.vertices[a] - center, q = mesh.vertices[b] - center, r = mesh.vertices[c] - center;
        const Vec3 normal = cross(q - p, r - p) * 0.5;
        shell.volume += dot(p, normal) / 3;
        shell.facing += normal;
        shell.area += norm(normal);
    }
    double bodies = 0, cavities = 0;
    for (const Shell& shell : shells) {
        (shell.volume < 0 ? cavities : bodies) += shell.nearly_closed() ? std::abs(shell.volume) : 0;
    }
    constexpr double rounding = 1e-6; // all that remains of a sheet, which has no inside
    return cavities > rounding * bodies ? std::min(cavities, bodies) : 0;
}

} // namespace foam::inline geometry
