#include "cloud.hpp"
#include "by_spheres/measured/points.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline search::convex {
namespace {

constexpr std::size_t lanes = 8;

/// Coordinates one after another, filled up to whole lanes.
struct FloatPoints {
    std::vector<float> x, y, z;
};

struct Ends {
    std::uint32_t lowest = 0, highest = 0;
};

FOAM_FOR_WIDE_VECTORS
Ends ends_along(const FloatPoints& points, float dx, float dy, float dz) {
    float low[lanes], high[lanes];
    std::uint32_t lowest[lanes]{}, highest[lanes]{};
    for (std::size_t l = 0; l < lanes; ++l) {
        low[l] = std::numeric_limits<float>::infinity();
        high[l] = -low[l];
    }
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    for (std::size_t i = 0; i < points.x.size(); i += lanes) {
        for (std::size_t l = 0; l < lanes; ++l) {
            const float at = dx * x[i + l] + dy * y[i + l] + dz * z[i + l];
            const auto index = static_cast<std::uint32_t>(i + l);
            lowest[l] = at < low[l] ? index : lowest[l];
            low[l] = at < low[l] ? at : low[l];
            highest[l] = at > high[l] ? index : highest[l];
            high[l] = at > high[l] ? at : high[l];
        }
    }
    std::size_t bottom = 0, top = 0;
    for (std::size_t l = 1; l < lanes; ++l) {
        bottom = low[l] < low[bottom] ? l : bottom;
        top = high[l] > high[top] ? l : top;
    }
    return {lowest[bottom], highest[top]};
}

} // namespace

static std::vector<Vec3> farthest_of(std::span<const Vec3> points, const std::vector<Vec3>& all_around) {
    const std::span directions = std::span(all_around).first(all_around.size() / 2); // the opposite ones are the others
    constexpr std::size_t few = 24;
    if (points.size() <= few) {
        return {points.begin(), points.end()};
    }
    FloatPoints floats;
    const std::size_t padded = (points.size() + lanes - 1) / lanes * lanes;
    for (auto* values : {&floats.x, &floats.y, &floats.z}) {
        values->reserve(padded);
    }
    for (std::size_t i = 0; i < padded; ++i) {
        const Vec3& p = points[std::min(i, points.size() - 1)];
        floats.x.push_back(static_cast<float>(p.x));
        floats.y.push_back(static_cast<float>(p.y));
        floats.z.push_back(static_cast<float>(p.z));
    }
    std::vector<char> taken(padded, 0);
    for (const Vec3& d : directions) {
        const Ends ends = ends_along(floats, static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
        taken[ends.lowest] = taken[ends.highest] = 1;
    }
    std::vector<Vec3> extremes;
    for (std::size_t i = 0; i < padded; ++i) {
        if (taken[i]) {
            extremes.push_back(points[std::min(i, points.size() - 1)]);
        }
    }
    return extremes;
}

std::vector<Vec3> extremes_of(std::span<const Vec3> points) {
    static const std::vector<Vec3> directions = fibonacci_directions(400);
    return farthest_of(points, directions);
}

std::vector<Vec3> few_extremes_of(std::span<const Vec3> points) {
    static const std::vector<Vec3> directions = fibonacci_directions(64);
    return farthest_of(points, directions);
}

} // namespace foam::inline search::convex
