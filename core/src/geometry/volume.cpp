// Volume of a union of parts.
#include "geometry/solid_data.hpp"

#include <foam/parallel.hpp>
#include <foam/random.hpp>

namespace foam::geometry {
namespace {

constexpr std::size_t lines_across = 48; // a side of the grid of lines along each axis

/// What a line tells: the length inside the union, and the parts' windings integrated along it.
struct LineSums {
    double inside = 0, wound = 0;
    bool once = true; ///< nowhere on the line do the two differ
};

double length(std::span<const Solid::Interval> intervals) {
    double sum = 0;
    for (const Solid::Interval& interval : intervals) {
        sum += interval.leave - interval.enter;
    }
    return sum;
}

LineSums along(const SolidData& data, const Vec3& origin, const Vec3& direction, std::vector<Crossing>& scratch,
               std::vector<WindingPiece>& pieces, std::vector<Solid::Interval>& intervals) {
    LineSums sums;
    pieces.clear();
    intervals.clear();
    const double noise = 1e-9 * data.box.diagonal();
    for (const PartQueries& part : data.queries) {
        if (part.closed()) {
            winding_along(part, origin, direction, scratch, pieces);
            continue;
        }
        const std::size_t before = intervals.size();
        const double wound = open_along(part.mesh, origin, direction, scratch, intervals);
        sums.wound += wound;
        sums.once = sums.once && std::abs(wound - length({intervals.begin() + before, intervals.end()})) <= noise;
    }
    for (const WindingPiece& piece : pieces) {
        sums.wound += piece.winding * (piece.leave - piece.enter);
        sums.once = sums.once && ((piece.winding == 1) || piece.leave - piece.enter < noise);
        if (piece.winding > 0) {
            intervals.push_back({piece.enter, piece.leave});
        }
    }
    unite(intervals);
    sums.inside = length(intervals);
    sums.once = sums.once && std::abs(sums.inside - sums.wound) <= noise;
    return sums;
}

} // namespace

/// The parts' own volumes are exact; lines tell how much of that is wound around more than once, and how much
/// what closes holes takes in more than the winding number does. That correction is zero for closed parts that do not
/// overlap, and then no error comes in.
double union_of_parts_volume(const SolidData& data) {
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

} // namespace foam::geometry
