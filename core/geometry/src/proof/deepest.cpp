#include "proof/deepest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline geometry {
namespace {

double depth_of(std::span<const Element> elements, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Element& element : elements) {
        least = is_valid(element) ? std::min(least, signed_distance(element, p)) : least;
    }
    return least;
}

/// Returns the unit vectors from a cube's middle to its faces and corners.
Vec3 direction(int k) {
    constexpr int faces = 6;
    if (k < faces) {
        Vec3 way{};
        way[k / 2] = k % 2 == 0 ? 1 : -1;
        return way;
    }
    const int corner = k - faces;
    const double along = 1 / std::sqrt(3.0);
    return {corner & 1 ? along : -along, corner & 2 ? along : -along, corner & 4 ? along : -along};
}

} // namespace

DeepPoint deepest_from(const SolidData& solid, std::span<const Element> elements, const Vec3& p, double step,
                       double least) {
    constexpr int most_steps = 60, directions = 14;
    DeepPoint best{p, depth_of(elements, p)};
    for (int i = 0; i < most_steps && step >= least; ++i) {
        DeepPoint next = best;
        for (int k = 0; k < directions; ++k) {
            const Vec3 there = best.point + direction(k) * step;
            const double depth = depth_of(elements, there);
            if (depth > next.depth && solid.distance_to_filled(there) < 0) {
                next = {there, depth};
            }
        }
        step = next.depth > best.depth ? 2 * step : step / 4;
        best = next;
    }
    const bool inside = best.depth > 0 && solid.distance_to_filled(best.point) < 0;
    return {best.point, inside ? best.depth : 0};
}

} // namespace foam::inline geometry
