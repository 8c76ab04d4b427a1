#include "by_spheres/portfolio/problem.hpp"

#include "by_spheres/measured/points.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {
namespace {

/// A box.
struct PlaceInBox {
    float x, y, z;    ///< middle
    float hx, hy, hz; ///< half the sizes
};

FOAM_FOR_WIDE_VECTORS
void powers_at(const Rivals& balls, const PlaceInBox& at, float* power) {
    const float *x = balls.centers.x.data(), *y = balls.centers.y.data(), *z = balls.centers.z.data(),
                *r = balls.radius.data();
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const float dx = x[i] - at.x, dy = y[i] - at.y, dz = z[i] - at.z;
        power[i] = dx * dx + dy * dy + dz * dz - r[i] * r[i];
    }
}

/// Computes how far each power stays above that of `best` in the box; not above zero if it may be less.
FOAM_FOR_WIDE_VECTORS
void clearances(const Rivals& balls, const PlaceInBox& at, std::size_t best, const float* power, float* above) {
    constexpr float rounding = 4e-6f; // of a power by squares, with the room that a sum of several needs
    const float *x = balls.centers.x.data(), *y = balls.centers.y.data(), *z = balls.centers.z.data(),
                *r = balls.radius.data();
    const float bx = x[best], by = y[best], bz = z[best], least = power[best];
    const float own = least + 2 * r[best] * r[best] + at.hx * at.hx + at.hy * at.hy + at.hz * at.hz;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const float turn =
            2 * (std::abs(x[i] - bx) * at.hx + std::abs(y[i] - by) * at.hy + std::abs(z[i] - bz) * at.hz);
        above[i] = power[i] - least - turn - rounding * (power[i] + 2 * r[i] * r[i] + own);
    }
}

/// Returns the middle of the points' box and half its sizes, slightly enlarged.
PlaceInBox box_of(const Points& points, std::size_t begin, std::size_t end) {
    constexpr float wider = 1 + 1e-6f, hair = 1e-6f; // more than rounding
    const auto range = [&](const std::vector<float>& values, float& middle, float& half) {
        float low = values[begin], high = low;
        for (std::size_t p = begin; p < end; ++p) {
            low = values[p] < low ? values[p] : low;
            high = values[p] > high ? values[p] : high;
        }
        middle = (low + high) / 2;
        half = std::max(high - middle, middle - low) * wider + hair;
    };
    PlaceInBox box{};
    range(points.x, box.x, box.hx);
    range(points.y, box.y, box.hy);
    range(points.z, box.z, box.hz);
    return box;
}

} // namespace

Rivals all_rivals(const Balls& balls) {
    Rivals rivals;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        rivals.centers.add(center_of(balls[i]));
        rivals.radius.push_back(balls[i].r);
        rivals.index.push_back(static_cast<std::int32_t>(i));
    }
    return rivals;
}

void RivalSearch::find(const Rivals& from, const Points& points, std::size_t begin, std::size_t end, Rivals& result) {
    const PlaceInBox box = box_of(points, begin, end);
    power_.resize(from.size());
    above_.resize(from.size());
    powers_at(from, box, power_.data());
    const auto best = static_cast<std::size_t>(std::min_element(power_.begin(), power_.end()) - power_.begin());
    clearances(from, box, best, power_.data(), above_.data());
    result.centers.resize(from.size());
    result.radius.resize(from.size());
    result.index.resize(from.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        result.centers.x[count] = from.centers.x[i];
        result.centers.y[count] = from.centers.y[i];
        result.centers.z[count] = from.centers.z[i];
        result.radius[count] = from.radius[i];
        result.index[count] = from.index[i];
        count += above_[i] > 0 ? 0 : 1; // what is not a number is kept
    }
    result.centers.resize(count);
    result.radius.resize(count);
    result.index.resize(count);
}

} // namespace foam::inline search::by_spheres
