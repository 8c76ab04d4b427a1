// The farthest of many points along any direction.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A tree of boxes around points, for their largest distance from planes. Where most points are far below a plane, a
/// question takes O(log n).
class FarthestPoint {
public:
    /// O(n log n).
    explicit FarthestPoint(std::vector<Vec3> points);

    /// Returns the largest dot(normal, p - at) of the points, and `least` if that is more.
    double above(const Vec3& normal, const Vec3& at, double least) const;

private:
    struct Node {
        Vec3 center{}, half{};           ///< of the box
        std::uint32_t begin, end;        ///< of its points
        std::uint32_t low = 0, high = 0; ///< its parts; 0: none
    };
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<Vec3> points_;
    std::vector<Node> nodes_;
};

} // namespace gnu::visibility("default")]]geometry
} // namespace foam
