#include "collapsing_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline search::convex {
namespace {

constexpr double least_depth = 1e-10;

/// Three planes that meet in a point.
class ThreePlanes {
public:
    ThreePlanes(const Vec3& sum, double reach) : sum_(sum) {
        for (int axis = 0; axis < 3; ++axis) { // the corner of the reach that is least along the sum
            HalfSpace& plane = planes_[static_cast<std::size_t>(axis)];
            plane = {{}, -reach, 0};
            plane.normal[axis] = sum[axis] < 0 ? -1 : 1;
        }
        update();
    }
    const Vec3& point() const { return point_; }

    /// Replaces one of the three planes by one that the point is not beyond. `sum` stays a sum of the normals with
    /// factors of at least 0, so the new point is the best for the new three. Returns false if no point is beyond all
    /// planes, or if the three are nearly parallel to a line.
    bool enter(const HalfSpace& plane) {
        constexpr double least_share = 1e-7;
        double least = 0;
        std::size_t leaving = planes_.size();
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const double share = dot(plane.normal, dual_[i]);
            if (share < least_share) {
                continue;
            }
            const double ratio = std::max(dot(sum_, dual_[i]), 0.0) / share;
            if (leaving == planes_.size() || ratio < least) {
                least = ratio;
                leaving = i;
            }
        }
        if (leaving == planes_.size()) {
            return false;
        }
        planes_[leaving] = plane;
        return update();
    }

private:
    bool update() {
        const Vec3 &a = planes_[0].normal, &b = planes_[1].normal, &c = planes_[2].normal;
        const double det = dot(a, cross(b, c));
        if (std::abs(det) < 1e-12) {
            return false;
        }
        dual_ = {cross(b, c) / det, cross(c, a) / det, cross(a, b) / det};
        point_ = dual_[0] * planes_[0].offset + dual_[1] * planes_[1].offset + dual_[2] * planes_[2].offset;
        return true;
    }

    Vec3 sum_; ///< of weight · normal
    std::array<HalfSpace, 3> planes_{};
    std::array<Vec3, 3> dual_{}; ///< dot(dual[i], normal[k]) is 1 for i = k, else 0
    Vec3 point_{};
};

} // namespace

std::optional<Vec3> least_beyond(std::span<const HalfSpace> planes, double reach) {
    Vec3 sum{};
    for (const HalfSpace& plane : planes) {
        sum += plane.normal * plane.weight;
    }
    ThreePlanes basis(sum, reach);
    constexpr int most_steps = 60; // against cycles
    for (int step = 0; step < most_steps; ++step) {
        const HalfSpace* worst = nullptr;
        double deepest = least_depth;
        for (const HalfSpace& plane : planes) {
            if (const double depth = plane.offset - dot(plane.normal, basis.point()); depth > deepest) {
                deepest = depth;
                worst = &plane;
            }
        }
        if (!worst) {
            return basis.point();
        }
        if (!basis.enter(*worst)) {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

} // namespace foam::inline search::convex
