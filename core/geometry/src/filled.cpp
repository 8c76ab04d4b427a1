#include <foam/geometry/internal/filled.hpp>

#include <foam/base/parallel.hpp>
#include <foam/geometry/directions.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace foam::inline geometry {
namespace {

constexpr std::size_t cells_along = 48, lines = 16;

/// A grid of cubes around a solid.
class CellGrid {
public:
    explicit CellGrid(const Solid& solid) : origin_(solid.bounds().low) {
        const Vec3 size = solid.bounds().size();
        cell_ = std::max({size.x, size.y, size.z}) / cells_along;
        for (const auto& [axis, length] : {std::pair{0, size.x}, {1, size.y}, {2, size.z}}) {
            count_[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / cell_)));
        }
    }

    using Cell = std::array<std::size_t, 3>;
    std::size_t size() const { return count_[0] * count_[1] * count_[2]; }
    Cell cell(std::size_t i) const { return {i % count_[0], i / count_[0] % count_[1], i / (count_[0] * count_[1])}; }
    /// Returns the index of the neighbour along an axis; nothing at the end of the grid.
    std::optional<std::size_t> neighbour(const Cell& cell, int axis, int step) const {
        if ((step < 0 && cell[axis] == 0) || (step > 0 && cell[axis] + 1 == count_[axis])) {
            return {};
        }
        Cell other = cell;
        other[axis] += static_cast<std::size_t>(step);
        return (other[2] * count_[1] + other[1]) * count_[0] + other[0];
    }
    Vec3 corner(const Cell& at) const {
        return origin_ +
               Vec3{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])} * cell_;
    }
    Vec3 centre(const Cell& at) const { return corner(at) + Vec3{cell_, cell_, cell_} * 0.5; }
    /// Returns the radius of the sphere around a cell.
    double radius() const { return std::sqrt(0.75) * cell_; }

private:
    Vec3 origin_;
    double cell_ = 0;
    Cell count_{};
};

/// Returns whether most lines through the point meet the solid on both sides of it.
bool is_enclosed(const Solid& solid, const Vec3& point, const std::vector<Vec3>& directions) {
    std::size_t enclosing = 0;
    for (const Vec3& direction : directions) {
        const std::vector<Solid::Interval> inside = solid.inside_along(point, direction);
        enclosing += !inside.empty() && inside.front().enter < 0 && inside.back().leave > 0 ? 1 : 0;
    }
    return 2 * enclosing > directions.size();
}

/// Returns half of the directions of a sphere: lines have two.
std::vector<Vec3> directions_of_lines() {
    std::vector<Vec3> directions = fibonacci_directions(2 * lines);
    directions.resize(lines); // one hemisphere, as they are ordered by height
    return directions;
}

std::vector<char> enclosed_cells(const Solid& solid, const CellGrid& grid) {
    const std::vector<Vec3> directions = directions_of_lines();
    std::vector<char> enclosed(grid.size(), 0);
    parallel_for(grid.size(), [&](std::size_t i) {
        const Vec3 centre = grid.centre(grid.cell(i));
        enclosed[i] = solid.signed_distance(centre) > grid.radius() && is_enclosed(solid, centre, directions) ? 1 : 0;
    });
    return enclosed;
}

/// Returns the closed surface of the cells, outwards.
Mesh surface_of_cells(const CellGrid& grid, const std::vector<char>& cells) {
    Mesh mesh;
    std::map<CellGrid::Cell, std::uint32_t> known;
    const auto vertex = [&](const CellGrid::Cell& at) {
        const auto [it, fresh] = known.try_emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (fresh) {
            mesh.vertices.push_back(grid.corner(at));
        }
        return it->second;
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
    Mesh inside = surface_of_cells(grid, enclosed_cells(*solid, grid));
    if (inside.triangles.empty()) {
        return solid;
    }
    std::vector<Solid::Part> parts = solid->parts();
    parts.push_back({std::make_shared<const Mesh>(std::move(inside)), {}, {}});
    return Solid::make(std::move(parts));
}

} // namespace foam::inline geometry
