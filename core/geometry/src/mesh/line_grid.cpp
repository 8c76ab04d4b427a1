#include "mesh/line_grid.hpp"

#include "solid/intervals.hpp"
#include "mesh/mesh_part.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/random.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace foam::inline geometry {
namespace {

struct Hit {
    std::size_t line;
    Crossing crossing;
};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Adds the part of a triangle's edge a -> b, seen along the lines, between `from` and `to` of the first coordinate. If
/// the edge hardly moves there, it adds the whole edge.
void add_edge(double au, double av, double bu, double bv, double from, double to, double steep, Range& range) {
    if (au > bu) {
        std::swap(au, bu);
        std::swap(av, bv);
    }
    if (bu < from || au > to) {
        return;
    }
    if (bu - au < steep) {
        range.add(av);
        range.add(bv);
        return;
    }
    const double slope = (bv - av) / (bu - au);
    range.add(au < from ? av + slope * (from - au) : av);
    range.add(bu > to ? bv - slope * (bu - to) : bv);
}

/// Cells along one side of a grid.
class Cells {
public:
    Cells(const LineGrid& grid, int axis)
        : low_(grid.box.low[axis]), cell_(grid.box.size()[axis] / static_cast<double>(grid.across)),
          per_cell_(1 / cell_), across_(grid.across) {}

    double size() const { return cell_; }
    double begin(std::size_t i) const { return low_ + cell_ * static_cast<double>(i); }
    /// Returns the cells that the range reaches: first and one past the last. It widens the range slightly, as
    /// coordinates are rounded.
    std::pair<std::size_t, std::size_t> of(const Range& range) const {
        if (!(range.low <= range.high)) {
            return {0, 0};
        }
        if (!std::isfinite(per_cell_)) { // flat
            return {0, across_};
        }
        return {place((range.low - low_) * per_cell_ - margin), place((range.high - low_) * per_cell_ + margin + 1)};
    }
    /// Share of a cell.
    static constexpr double margin = 0.01;

private:
    std::size_t place(double cell) const {
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(across_)));
    }

    double low_, cell_, per_cell_;
    std::size_t across_;
};

/// The lines that may meet the triangle, row by row, by scan conversion (Wylie, Romney, Evans, Erdahl 1967).
class Rows {
public:
    explicit Rows(const LineGrid& grid)
        : u_((grid.axis + 1) % 3), v_((grid.axis + 2) % 3), across_(grid.across), rows_(grid, u_), places_(grid, v_),
          margin_(Cells::margin * rows_.size()), beside_(1e-9 * grid.box.diagonal()), lines_(grid.lines) {}

    template <class Visit> void for_each_line_near(const Corners& triangle, Visit visit) const {
        constexpr std::size_t few = 2; // rows: a closer look is not needed
        Range across, along;
        for (const Vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) {
            across.add((*corner)[u_]);
            along.add((*corner)[v_]);
        }
        const auto [first, last] = rows_.of(across);
        for (std::size_t row = first; row < last; ++row) {
            const auto [begin, end] = places_.of(last - first <= few ? along : within(triangle, row));
            for (std::size_t k = begin; k < end; ++k) {
                if (!misses(lines_[row * across_ + k].origin(), across, along)) {
                    visit(row * across_ + k);
                }
            }
        }
    }

    /// Returns whether any line may meet the box.
    bool any_near(const Box& box) const {
        const Range across{box.low[u_], box.high[u_]}, along{box.low[v_], box.high[v_]};
        const auto [first, last] = rows_.of(across);
        const auto [begin, end] = places_.of(along);
        for (std::size_t row = first; row < last; ++row) {
            for (std::size_t k = begin; k < end; ++k) {
                if (!misses(lines_[row * across_ + k].origin(), across, along)) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    bool misses(const Vec3& origin, const Range& across, const Range& along) const {
        return origin[u_] < across.low - beside_ || origin[u_] > across.high + beside_ ||
               origin[v_] < along.low - beside_ || origin[v_] > along.high + beside_;
    }

    /// Returns the extent of the triangle in a row.
    Range within(const Corners& triangle, std::size_t row) const {
        const auto& [a, b, c] = triangle;
        const double from = rows_.begin(row) - margin_, to = rows_.begin(row + 1) + margin_;
        Range along;
        add_edge(a[u_], a[v_], b[u_], b[v_], from, to, margin_, along);
        add_edge(b[u_], b[v_], c[u_], c[v_], from, to, margin_, along);
        add_edge(c[u_], c[v_], a[u_], a[v_], from, to, margin_, along);
        return along;
    }

    int u_, v_;
    std::size_t across_;
    Cells rows_, places_;
    double margin_;
    double beside_; ///< far more than rounding
    std::span<const Line> lines_;
};

/// Replaces a line by one beside it where rounding at several edges at once leaves a nonzero sum of changes. `first`:
/// the line of the first sum and of the first hits.
void take_beside(const MeshPart& part, const LineGrid& grid, std::size_t first, const std::vector<int>& sums,
                 std::vector<Hit>& hits) {
    if (std::all_of(sums.begin(), sums.end(), [](int sum) { return sum == 0; })) {
        return;
    }
    std::erase_if(hits, [&](const Hit& hit) { return sums[hit.line] != 0; });
    std::vector<Crossing> crossings;
    for (std::size_t line = 0; line < sums.size(); ++line) {
        if (sums[line] != 0) {
            check_cancelled();
            const Line& along = grid.lines[first + line];
            part.crossings(along.origin(), along.direction(), crossings);
            for (const Crossing& crossing : crossings) {
                hits.push_back({line, crossing});
            }
        }
    }
}

} // namespace

LineGrid::LineGrid(const Box& bounds, int parallel_to, std::size_t lines_a_side, std::string_view stream)
    : box(bounds), axis(parallel_to), across(lines_a_side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vec3 size = box.size();
    const auto count = static_cast<double>(across);
    lines.reserve(across * across);
    for (std::size_t row = 0; row < across; ++row) {
        Random random(derive_seed(static_cast<std::size_t>(axis) * across + row, stream));
        for (std::size_t k = 0; k < across; ++k) {
            Vec3 origin = box.low;
            origin[u] += size[u] * (static_cast<double>(row) + random.uniform()) / count;
            origin[v] += size[v] * (static_cast<double>(k) + random.uniform()) / count;
            lines.emplace_back(origin, along(axis));
        }
    }
}

double LineGrid::cell_area() const {
    const Vec3 size = box.size();
    return size[(axis + 1) % 3] * size[(axis + 2) % 3] / static_cast<double>(across * across);
}

LineGrid::Near LineGrid::near(const Box& of) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto [first, last] = Cells(*this, u).of({of.low[u], of.high[u]});
    const auto [begin, end] = Cells(*this, v).of({of.low[v], of.high[v]});
    return {first, last, begin, end};
}

GridCrossings::GridCrossings(const MeshPart& part, const LineGrid& grid) {
    const LineGrid::Near near = grid.near(part.bounds()); // the closing surface lies in its box, too
    if (near.first_row >= near.last_row || near.begin >= near.end) {
        return;
    }
    first_ = near.first_row * grid.across + near.begin;
    const std::size_t count = (near.last_row - 1) * grid.across + near.end - first_;
    std::vector<Hit> hits;
    std::vector<int> sums(count);
    const Rows rows(grid);
    CancellationCounter asking(1024);
    const auto wanted = [&](const Box& box) { return rows.any_near(box); };
    part.for_each_closed(wanted, [&](const Corners& triangle) {
        asking.check();
        rows.for_each_line_near(triangle, [&](std::size_t line) {
            double t = 0;
            if (line < first_ || line - first_ >= count) {
                return; // just outside the box
            }
            if (const int change = grid.lines[line].cross(triangle, t); change != 0) {
                hits.push_back({line - first_, {t, change}});
                sums[line - first_] += change;
            }
        });
    });
    take_beside(part, grid, first_, sums, hits);
    begins_.resize(count + 1);
    for (const Hit& hit : hits) {
        ++begins_[hit.line + 1];
    }
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    crossings_.resize(hits.size());
    std::vector<std::size_t> places = begins_;
    for (const Hit& hit : hits) {
        crossings_[places[hit.line]++] = hit.crossing;
    }
    for (std::size_t line = 0; line < count; ++line) {
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(begins_[line]),
                  crossings_.begin() + static_cast<std::ptrdiff_t>(begins_[line + 1]));
    }
}

} // namespace foam::geometry
