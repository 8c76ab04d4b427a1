// Volume of a union of parts.
#include "geometry/solid_data.hpp"

#include <foam/parallel.hpp>
#include <foam/random.hpp>

namespace foam::geometry {
namespace {

constexpr std::size_t lines_across = 48; // a side of the grid of lines along each axis
constexpr std::size_t cells_across = 56; // a side of the grid of points, for open solids

/// What a line tells: the length inside the union, and the parts' windings integrated along it.
struct LineSums {
    double inside = 0, wound = 0;
    bool once = true; ///< nowhere on the line do the two differ
};

LineSums along(const SolidData& data, const Vec3& origin, const Vec3& direction, std::vector<Crossing>& scratch,
               std::vector<WindingPiece>& pieces, std::vector<Solid::Interval>& intervals) {
    LineSums sums;
    pieces.clear();
    intervals.clear();
    for (const PartQueries& part : data.queries) {
        winding_along(part, origin, direction, scratch, pieces);
    }
    const double noise = 1e-9 * data.box.diagonal();
    for (const WindingPiece& piece : pieces) {
        sums.wound += piece.winding * (piece.leave - piece.enter);
        sums.once = sums.once && ((piece.winding == 1) || piece.leave - piece.enter < noise);
        if (piece.winding > 0) {
            intervals.push_back({piece.enter, piece.leave});
        }
    }
    unite(intervals);
    for (const Solid::Interval& interval : intervals) {
        sums.inside += interval.leave - interval.enter;
    }
    sums.once = sums.once && std::abs(sums.inside - sums.wound) <= noise;
    return sums;
}

/// The parts' own volumes are exact; lines tell how much of that is wound around more than once. That correction is
/// zero for parts that do not overlap, and then no error comes in.
double closed_volume(const SolidData& data) {
    double exact = 0;
    for (const PartQueries& part : data.queries) {
        exact += part.volume();
    }
    if (data.queries.size() == 1 && data.queries[0].primitive) {
        return exact;
    }
    const Vec3 size = data.box.size();
    std::vector<double> surplus(3 * lines_across, 0.0);
    parallel_for(surplus.size(), [&](std::size_t task) {
        const int axis = static_cast<int>(task / lines_across);
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::vector<Crossing> scratch;
        std::vector<WindingPiece> pieces;
        std::vector<Solid::Interval> intervals;
        Random random(derive_seed(task, "volume"));
        Vec3 direction{};
        direction[axis] = 1;
        for (std::size_t k = 0; k < lines_across; ++k) {
            Vec3 origin = data.box.low;
            origin[u] += size[u] * (static_cast<double>(task % lines_across) + random.uniform()) / lines_across;
            origin[v] += size[v] * (static_cast<double>(k) + random.uniform()) / lines_across;
            const LineSums sums = along(data, origin, direction, scratch, pieces, intervals);
            surplus[task] += sums.once ? 0 : (sums.wound - sums.inside) * size[u] * size[v];
        }
    });
    double sum = 0;
    for (const double s : surplus) {
        sum += s;
    }
    return std::max(0.0, exact - sum / (3.0 * lines_across * lines_across));
}

/// One point in each cell of a grid over the box.
double open_volume(const SolidData& data, const Solid& solid) {
    const Vec3 size = data.box.size();
    std::vector<std::size_t> inside(cells_across, 0);
    parallel_for(cells_across, [&](std::size_t x) {
        Random random(derive_seed(x, "volume"));
        for (std::size_t y = 0; y < cells_across; ++y) {
            for (std::size_t z = 0; z < cells_across; ++z) {
                const auto place = [&](std::size_t cell) {
                    return (static_cast<double>(cell) + random.uniform()) / cells_across;
                };
                const Vec3 share{place(x), place(y), place(z)};
                inside[x] += solid.contains(data.box.low + Vec3{share.x * size.x, share.y * size.y, share.z * size.z});
            }
        }
    });
    std::size_t count = 0;
    for (const std::size_t n : inside) {
        count += n;
    }
    constexpr double cells = static_cast<double>(cells_across * cells_across * cells_across);
    return size.x * size.y * size.z * (static_cast<double>(count) / cells);
}

} // namespace

double union_of_parts_volume(const SolidData& data, const Solid& solid) {
    return data.closed ? closed_volume(data) : open_volume(data, solid);
}

} // namespace foam::geometry
