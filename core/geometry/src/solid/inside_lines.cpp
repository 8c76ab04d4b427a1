#include "solid/inside_lines.hpp"

#include "mesh/line_grid.hpp"
#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>
#include <foam/base/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace foam::inline geometry {
namespace {

// Lines per side of the grid for each axis. Inside is known exactly except near holes.
constexpr std::size_t across_closed = 48, across_open = 24, across_overlaps = 96;
constexpr double noise = 1e-9; // share of the box: the accuracy of every length

/// Lines along an axis, and their crossings with each mesh part of a solid.
struct TracedGrid {
    LineGrid grid;
    std::vector<GridCrossings> crossings{};
    std::vector<std::vector<std::uint32_t>> parts{}; ///< those that each line may meet, ascending
};
using TracedGrids = std::vector<TracedGrid>; // one for each axis

TracedGrids traced(const SolidData& data, std::size_t across, std::string_view stream) {
    TracedGrids grids;
    for (int axis = 0; axis < 3; ++axis) {
        grids.push_back({LineGrid(data.box, axis, across, stream)});
    }
    parallel_for(grids.size(), [&](std::size_t axis) {
        TracedGrid& traced = grids[axis];
        traced.parts.resize(traced.grid.lines.size());
        for (std::uint32_t i = 0; i < data.queries.size(); ++i) {
            check_cancelled();
            const PartQueries& part = data.queries[i];
            traced.crossings.push_back(part.primitive ? GridCrossings{} : GridCrossings(part.mesh(), traced.grid));
            const LineGrid::Near near = traced.grid.near(part.box);
            for (std::size_t row = near.first_row; row < near.last_row; ++row) {
                for (std::size_t k = near.begin; k < near.end; ++k) {
                    traced.parts[row * across + k].push_back(i);
                }
            }
        }
    });
    return grids;
}

/// A line and the parts of a solid.
struct Tracer {
    const SolidData& data;
    const TracedGrid& grid;
    std::size_t line;
    std::vector<WindingPiece> pieces{};
    Intervals intervals{};

    const Line& along() const { return grid.grid.lines[line]; }
    std::span<const Crossing> crossings(std::size_t part) const {
        return data.queries[part].primitive ? std::span<const Crossing>{} : grid.crossings[part].of(line);
    }

    /// Computes where the line is inside the parts and their closing surfaces. Returns how much longer that is when
    /// weighted by the winding number.
    double closed_along() {
        pieces.clear();
        intervals.clear();
        for (const std::uint32_t part : grid.parts[line]) {
            winding_along(data.queries[part], along(), crossings(part), pieces);
        }
        double wound = 0;
        for (const WindingPiece& piece : pieces) {
            wound += piece.winding * (piece.leave - piece.enter);
            if (piece.winding > 0) {
                intervals.push_back({piece.enter, piece.leave});
            }
        }
        unite(intervals);
        return surplus(wound, length(intervals));
    }

    /// Returns where the line is inside the solid. `known`: the same for the parts before `first`.
    Intervals inside_along(std::span<const Solid::Interval> known, std::size_t first) {
        Intervals result(known.begin(), known.end());
        for (const std::uint32_t part : grid.parts[line]) {
            if (part >= first) {
                add_inside_along(data.queries[part], along(), crossings(part), whole_line, pieces, result);
            }
        }
        unite(result);
        return result;
    }

    double surplus(double more, double less) const {
        return std::abs(more - less) <= noise * data.box.diagonal() ? 0 : more - less;
    }
};

/// Integrates over the box a quantity that is known along lines: `of_line(row, tracer)`, m, with rows counted over all
/// axes. The variance is that of collapsed strata (Cochran 1977, Sampling Techniques, 5A.12): two neighbouring
/// cells count as one with two lines.
template <class OfLine> Estimate integral(const SolidData& data, const TracedGrids& grids, OfLine of_line) {
    const std::size_t across = grids.front().grid.across;
    std::vector<Estimate> rows(3 * across); // value: sum; error: sum of squares
    parallel_for(rows.size(), [&](std::size_t row) {
        double last = 0;
        Tracer tracer{data, grids[row / across], row % across * across};
        CancellationCounter cancellation(8);
        for (std::size_t k = 0; k < across; ++k, ++tracer.line) {
            cancellation.check();
            const double value = of_line(row, tracer);
            rows[row].value += value;
            rows[row].error += k % 2 == 1 ? (value - last) * (value - last) : 0;
            last = value;
        }
    });
    Estimate result;
    double variance = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const double share = grids[row / across].grid.cell_area() / 3; // each axis is an estimate
        result.value += share * rows[row].value;
        variance += share * share * rows[row].error;
    }
    result.error = std::sqrt(variance);
    return result;
}

/// Returns the lines of the solid without its last part, if they are the same; nothing is gained where no mesh is open.
const InsideLines* known_lines(const SolidData& data) {
    if (!data.base || data.base->closed()) {
        return nullptr;
    }
    const Box& box = data.base->bounds();
    return box.low == data.box.low && box.high == data.box.high ? &inside_lines(*data.base) : nullptr;
}

} // namespace

/// Computes the volume. The parts' own volumes with their closing surfaces are exact. Lines give the share of it that
/// is wound around more than once: zero for parts that do not overlap, which then adds no error. The difference between
/// the closing surfaces and the winding number is costly to compute but small, so it uses few lines (Giles 2015,
/// "Multilevel Monte Carlo methods"). A solid with one part more has the same lines. A solid that is thinner than the
/// accuracy of lengths has no volume: every share of it would be rounding.
InsideLines::InsideLines(const SolidData& data)
    : box_(data.box), across_(data.closed() ? across_closed : across_open), rows_(3 * across_) {
    const InsideLines* const base = known_lines(data);
    const std::size_t parts_of_base = base ? SolidAccess::data(*data.base).queries.size() : 0;
    const auto keep = [&](std::size_t row, const Vec3& origin, const Intervals& inside) {
        rows_[row].inside.insert(rows_[row].inside.end(), inside.begin(), inside.end());
        rows_[row].origins.push_back(origin);
        rows_[row].ends.push_back(rows_[row].inside.size());
    };
    const auto overlap = [&](std::size_t row, Tracer& tracer) {
        const double surplus = tracer.closed_along();
        if (data.closed()) {
            keep(row, tracer.along().origin(), tracer.intervals);
        }
        return surplus;
    };
    const auto in_holes = [&](std::size_t row, Tracer& tracer) {
        tracer.closed_along();
        const auto known = base ? base->inside(row, tracer.line % across_) : std::span<const Solid::Interval>{};
        const Intervals inside = tracer.inside_along(known, parts_of_base);
        keep(row, tracer.along().origin(), inside);
        return tracer.surplus(length(tracer.intervals), length(inside));
    };
    double exact = 0;
    for (const PartQueries& part : data.queries) {
        check_cancelled();
        exact += part.volume();
    }
    const Estimate overlaps = integral(
        data, data.closed() ? traced(data, across_closed, "volume") : traced(data, across_overlaps, "overlaps"),
        overlap);
    const Estimate holes = data.closed() ? Estimate{} : integral(data, traced(data, across_open, "volume"), in_holes);
    const double value = exact - overlaps.value - holes.value;
    const double accuracy = noise * box_.diagonal() * data.area / 2; // each line enters and leaves
    volume_ = {value > accuracy ? value : 0, foam::hypot(overlaps.error, holes.error)};
}

double InsideLines::shortest() const {
    return noise * box_.diagonal();
}

double InsideLines::share(std::size_t row) const {
    const int u = (axis_of(row) + 1) % 3, v = (axis_of(row) + 2) % 3;
    const Vec3 size = box_.size();
    return size[u] * size[v] / static_cast<double>(across_ * across_) / 3; // each axis is an estimate
}

bool InsideLines::reaches(std::size_t row, const Sphere& ball) const {
    const int u = (axis_of(row) + 1) % 3;
    const double cell = box_.size()[u] / static_cast<double>(across_);
    const double from = box_.low[u] + cell * static_cast<double>(row % across_);
    return reaches_between(ball, u, from, from + cell);
}

void InsideLines::balls_at(std::size_t row, std::span<const Sphere> balls, std::vector<Sphere>& result) const {
    result.clear();
    std::copy_if(balls.begin(), balls.end(), std::back_inserter(result),
                 [&](const Sphere& ball) { return reaches(row, ball); });
}

bool InsideLines::meets_any(std::size_t row, std::size_t line, std::span<const Sphere> balls) const {
    const int u = (axis_of(row) + 1) % 3, v = (axis_of(row) + 2) % 3;
    const Vec3& origin = rows_[row].origins[line];
    return std::any_of(balls.begin(), balls.end(), [&](const Sphere& s) {
        const double du = s.center[u] - origin[u], dv = s.center[v] - origin[v];
        return du * du + dv * dv <= s.radius * s.radius;
    });
}

double InsideLines::length_outside(std::size_t row, std::size_t line, std::span<const Sphere> balls,
                                   Scratch& scratch) const {
    const Row& lines = rows_[row];
    const std::size_t begin = line == 0 ? 0 : lines.ends[line - 1], end = lines.ends[line];
    if (begin == end) {
        return 0;
    }
    const auto inside = std::span(lines.inside).subspan(begin, end - begin);
    const Vec3& origin = lines.origins[line];
    if (one_holds(balls, origin, axis_of(row), inside.front().enter, inside.back().leave)) {
        return 0;
    }
    balls_along(balls, origin, axis_of(row), scratch.in_balls);
    without(inside, scratch.in_balls, noise * box_.diagonal(), scratch.pieces);
    return length(scratch.pieces);
}

double InsideLines::outside(std::span<const Sphere> spheres) const {
    std::vector<Sphere> balls;
    std::copy_if(spheres.begin(), spheres.end(), std::back_inserter(balls),
                 [](const Sphere& s) { return is_finite(s.center) && std::isfinite(s.radius) && s.radius > 0; });
    const double shortest = noise * box_.diagonal();
    constexpr std::size_t at_once = 8; // consecutive lines of a row
    double sum = 0;
    std::vector<Sphere> near, nearer;
    Scratch scratch;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        check_cancelled();
        const int v = (axis_of(row) + 2) % 3;
        const double width = box_.size()[v] / static_cast<double>(across_);
        balls_at(row, balls, near);
        double outside = 0;
        for (std::size_t k = 0; k < across_; ++k) {
            if (k % at_once == 0) {
                const double first = box_.low[v] + width * static_cast<double>(k);
                balls_between(near, v, first - shortest, first + width * at_once + shortest, nearer);
            }
            outside += length_outside(row, k, nearer, scratch);
        }
        sum += share(row) * outside;
    }
    return sum;
}

} // namespace foam::inline geometry
