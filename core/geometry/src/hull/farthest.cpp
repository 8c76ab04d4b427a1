#include <foam/geometry/internal/quickhull.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline geometry {

FarthestPoint::FarthestPoint(std::vector<Vec3> points) : points_(std::move(points)) {
    if (!points_.empty()) {
        build(0, static_cast<std::uint32_t>(points_.size()));
    }
}

std::uint32_t FarthestPoint::build(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t few = 8;
    Box box;
    for (std::uint32_t i = begin; i < end; ++i) {
        box.add(points_[i]);
    }
    const auto made = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({.center = box.center(), .half = box.size() / 2, .begin = begin, .end = end});
    if (end - begin > few) {
        const Vec3 size = box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::uint32_t i) { return points_.begin() + i; };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
        const std::uint32_t low = build(begin, middle), high = build(middle, end);
        nodes_[made].low = low;
        nodes_[made].high = high;
    }
    return made;
}

double FarthestPoint::above(const Vec3& normal, const Vec3& at, double least) const {
    if (nodes_.empty()) {
        return least;
    }
    constexpr double rounding = 4e-15; // of the size: a box is left out where no point, by rounding, is above `least`
    const double slack = rounding * (norm(nodes_.front().half) + norm(nodes_.front().center - at));
    const Vec3 reach{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    struct Open {
        double most; ///< of the node's box
        std::uint32_t node;
    };
    const auto bounded = [&](std::uint32_t i) {
        return Open{dot(normal, nodes_[i].center - at) + dot(reach, nodes_[i].half) + slack, i};
    };
    std::array<Open, 64> open{bounded(0)}; // the depth is log2 n
    std::size_t count = 1;
    while (count > 0) {
        const auto [most, i] = open[--count];
        if (most <= least) {
            continue;
        }
        const Node& node = nodes_[i];
        if (node.low == 0) {
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                least = std::max(least, dot(normal, points_[k] - at));
            }
            continue;
        }
        const Open low = bounded(node.low), high = bounded(node.high);
        const bool low_first = low.most > high.most; // the farther part first: it excludes more of the others
        open[count++] = low_first ? high : low;
        open[count++] = low_first ? low : high;
    }
    return least;
}

} // namespace foam::geometry
