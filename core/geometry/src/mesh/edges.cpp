#include <foam/geometry/mesh_checks.hpp>

#include <numeric>

namespace foam::inline geometry {
namespace {

template <class Visit> void for_each_side(std::span<const Triangle> triangles, std::span<const char> use, Visit visit) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!use.empty() && !use[i]) {
            continue;
        }
        const Triangle& t = triangles[i];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[k == 2 ? 0 : k + 1];
            if (from != to) {
                visit(Side{std::min(from, to), std::max(from, to), 3 * i + k, from < to});
            }
        }
    }
}

/// Sorts by the higher end, stable. Uses insertion sort for few sides, as at nearly all vertices.
void sort_by_higher_end(std::span<Side> sides) {
    if (sides.size() > 32) {
        std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.high < b.high; });
        return;
    }
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const Side side = sides[i];
        std::size_t k = i;
        for (; k > 0 && sides[k - 1].high > side.high; --k) {
            sides[k] = sides[k - 1];
        }
        sides[k] = side;
    }
}

} // namespace

std::vector<Side> sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count,
                                std::span<const char> use) {
    // A counting sort by the lower end leaves a few sides to sort at each vertex, in the order of their numbers.
    std::vector<std::uint32_t> start(vertex_count + 1, 0);
    for_each_side(triangles, use, [&](const Side& side) { ++start[side.low + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    check_cancelled();
    std::vector<Side> sides(start.back());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for_each_side(triangles, use, [&](const Side& side) { sides[next[side.low]++] = side; });
    CancellationCounter asking(1 << 16);
    check_cancelled();
    for (std::size_t v = 0; v < vertex_count; ++v) {
        asking.check();
        sort_by_higher_end(std::span(sides).subspan(start[v], start[v + 1] - start[v]));
    }
    return sides;
}

} // namespace foam::geometry
