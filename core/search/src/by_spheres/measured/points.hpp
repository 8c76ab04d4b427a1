// Points and balls in single precision, and directions over a sphere.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdlib>
#include <span>
#include <vector>

/// Compiles the following function once more for processors with AVX2; the loader picks the version. The results are
/// equal to the bit, as no operations are fused and none reordered. It is not used where sanitizers instrument what the
/// loader calls.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FOAM_FOR_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define FOAM_FOR_WIDE_VECTORS
#endif

namespace foam::inline search::by_spheres {

// Points and balls in the layout of the descent: coordinates apart and in single precision, so that compilers vectorise
// plain loops.

/// The unit frame. Lengths are in units of half the diagonal of the solid's bounds, about their middle, so that single
/// precision suffices for parts of a tenth of a micrometre and for parts a kilometre from the origin.
struct Frame {
    Vec3 origin{};
    double unit = 1; ///< m

    explicit Frame(const Box& bounds)
        : origin(bounds.center()), unit(bounds.diagonal() > 0 ? bounds.diagonal() / 2 : 1) {}
    Vec3 to_unit(const Vec3& p) const { return (p - origin) / unit; }
    Vec3 from_unit(const Vec3& p) const { return p * unit + origin; }
};

struct Points {
    std::vector<float> x, y, z;

    std::size_t size() const { return x.size(); }
    void add(const Vec3& p) {
        x.push_back(static_cast<float>(p.x));
        y.push_back(static_cast<float>(p.y));
        z.push_back(static_cast<float>(p.z));
    }
    void add(const Points& other, std::size_t i) {
        x.push_back(other.x[i]);
        y.push_back(other.y[i]);
        z.push_back(other.z[i]);
    }
    void append(const Points& other) {
        x.insert(x.end(), other.x.begin(), other.x.end());
        y.insert(y.end(), other.y.begin(), other.y.end());
        z.insert(z.end(), other.z.begin(), other.z.end());
    }
    void clear() { resize(0); }
    void resize(std::size_t count) {
        x.resize(count);
        y.resize(count);
        z.resize(count);
    }
    Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A ball of the search, in the unit frame.
struct Ball {
    float x = 0, y = 0, z = 0, r = 0;

    float squared_distance(float px, float py, float pz) const {
        const float dx = px - x, dy = py - y, dz = pz - z;
        return dx * dx + dy * dy + dz * dz;
    }
    bool operator==(const Ball&) const = default;
};
using Balls = std::vector<Ball>;

inline Vec3 center_of(const Ball& ball) {
    return {ball.x, ball.y, ball.z};
}
inline Ball ball_of(const Sphere& s) {
    return {static_cast<float>(s.center.x), static_cast<float>(s.center.y), static_cast<float>(s.center.z),
            static_cast<float>(s.radius)};
}
/// Converts from metres to the unit frame.
inline Ball unit_ball(const Sphere& s, const Frame& frame) {
    return ball_of({frame.to_unit(s.center), s.radius / frame.unit});
}
inline Balls unit_balls(std::span<const Sphere> spheres, const Frame& frame) {
    Balls balls;
    for (const Sphere& s : spheres) {
        balls.push_back(unit_ball(s, frame));
    }
    return balls;
}
/// Converts to spheres, still in the unit frame.
inline std::vector<Sphere> unit_spheres(const Balls& balls) {
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        spheres.push_back({{b.x, b.y, b.z}, b.r});
    }
    return spheres;
}
inline float squared_distance(const Ball& a, const Ball& b) {
    return a.squared_distance(b.x, b.y, b.z);
}
/// Returns whether the interiors of two balls meet.
inline bool meet(const Ball& a, const Ball& b) {
    const float sum = a.r + b.r;
    return squared_distance(a, b) < sum * sum;
}

/// Returns `count` unit vectors on the Fibonacci lattice, rotated by `turn`, so that different sets see different
/// directions.
Points spread_directions(std::size_t count, std::uint64_t turn);

} // namespace foam::inline search::by_spheres
