#include "cloud.hpp"

#include <foam/base/random.hpp>

#include <limits>
#include <numeric>

namespace foam::inline search::convex {

namespace {

constexpr double size = 4; // of the problem, at most

/// Returns the points moved by about 1e-6, each by another vector.
std::vector<Vec3> moved(std::span<const Vec3> points) {
    constexpr double moved_by = 1e-6;
    std::vector<Vec3> moved(points.begin(), points.end());
    Random random(points.size());
    for (Vec3& p : moved) {
        const std::uint64_t bits = random.bits();
        const auto part = [&](int shift) {
            return (static_cast<double>((bits >> shift) & 0xFFFFF) * 0x1p-20 - 0.5) * moved_by;
        };
        p += {part(0), part(20), part(40)};
    }
    return moved;
}

/// A hull that grows corner by corner.
struct GrowingHull {
    explicit GrowingHull(std::span<const Vec3> given)
        : points(moved(given)), hull(points, size, tolerance), grows(hull.begin()) {}
    double volume() const { return hull.volume(); }
    void grow() { grows = grows && hull.grow(); }

    static constexpr double tolerance = 2e-6;
    std::vector<Vec3> points;
    geometry::Quickhull hull;
    bool grows;
};

} // namespace

double volume_of_hull(std::span<const Vec3> points) {
    return volume_of_hulls(points, {}, std::numeric_limits<double>::infinity());
}

double volume_of_hulls(std::span<const Vec3> a, std::span<const Vec3> b, double limit) {
    GrowingHull one(a), other(b);
    while ((one.grows || other.grows) && one.volume() + other.volume() < limit) {
        one.grow();
        other.grow();
    }
    return one.volume() + other.volume();
}

bool HullOfPoints::run(std::span<const Vec3> points) {
    constexpr double tolerance = 1e-10;
    return run(points, tolerance);
}

bool HullOfPoints::run(std::span<const Vec3> points, double tolerance) {
    triangles_.clear();
    count_ = points.size();
    geometry::Quickhull hull(points, size, tolerance);
    if (!hull.run()) {
        return false;
    }
    triangles_ = hull.triangles();
    return true;
}

std::vector<std::uint32_t> HullOfPoints::vertices() const {
    std::vector<std::uint32_t> result;
    if (triangles_.empty()) {
        result.resize(count_);
        std::iota(result.begin(), result.end(), 0u);
        return result;
    }
    std::vector<char> used(count_, 0);
    for (const geometry::HullTriangle& t : triangles_) {
        for (const std::uint32_t c : t.corners) {
            used[c] = 1;
        }
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (used[i]) {
            result.push_back(i);
        }
    }
    return result;
}

std::vector<std::array<std::uint32_t, 2>> HullOfPoints::edges() const {
    std::vector<std::array<std::uint32_t, 2>> result;
    for (const geometry::HullTriangle& t : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (const std::uint32_t a = t.corners[k], b = t.corners[(k + 1) % 3]; a < b) {
                result.push_back({a, b});
            }
        }
    }
    return result;
}

} // namespace foam::inline search::convex
