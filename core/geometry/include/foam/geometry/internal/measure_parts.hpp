// The parts of figures, for searches that compute one alone.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A quantity and its standard error.
struct Estimate {
    double value = 0, error = 0;
};

struct Difference {
    Estimate excess;  ///< vol(U \ S), m³
    Estimate missing; ///< vol(S \ U), m³
};

/// Estimates vol(U \ S) and vol(S \ U). They differ by vol(U) - vol(S), and the smaller one is integrated along lines.
/// `covered`: the balls contain the whole surface.
Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, bool covered,
                             const MeasureOptions& options);

/// Returns the share of the surface's area that lies in the balls.
double covered_share(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options);

struct Protrusion {
    double exposed_area = 0, max = 0, mean = 0;
};
/// Returns the largest distance of the exposed surface of each ball from the solid, m; 0 where none is outside.
std::vector<double> protrusions(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);
/// Measures the exposed surface of the balls and its distance to the solid.
Protrusion protrusion(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);

class [[gnu::visibility("hidden")]] InsideLines; // of the library alone

/// The solid's lines outside a union of balls, each with its length. All balls are finite and have a radius. volume()
/// is bitwise equal to Solid::missing_volume() of the balls.
class MissingParts {
public:
    /// Without balls. The solid must outlive this.
    explicit MissingParts(const Solid& solid);

    /// Replaces the balls. Quick where few of them change: only lines through these are computed.
    void take(std::span<const Sphere> balls);
    /// Returns the volume, m³.
    double volume() const;
    /// Returns the volume if `first` is in the place of ball `i`, and `second` is one more.
    double volume_with(std::size_t i, const Sphere& first, const Sphere& second) const;

private:
    const InsideLines& lines_;
    std::vector<Sphere> balls_;
    std::vector<std::vector<std::uint32_t>> near_; ///< for each row of lines, the balls that reach it, ascending
    std::vector<std::vector<double>> lengths_;     ///< for each row and line
    std::vector<double> rows_;                     ///< their sums
};

/// Writes the other balls that cut ball `i` into `near`. Returns false if one of them contains it entirely (of equal
/// balls the first counts).
bool overlapping(std::span<const Sphere> balls, std::size_t i, std::vector<Sphere>& near);

/// Returns whether `p` lies outside all of `near`.
inline bool exposed(const Vec3& p, std::span<const Sphere> near) {
    for (const Sphere& s : near) {
        if (squared_norm(p - s.center) < s.radius * s.radius) {
            return false;
        }
    }
    return true;
}

/// The exposed part of a ball's surface, on the unit sphere: its area, and the integral of the normal over it.
struct ExposedPart {
    double area = 0;
    Vec3 normal{};
};

/// A union of balls with the exposed part of each. All balls are finite and have a radius.
class UnionParts {
public:
    explicit UnionParts(std::vector<Sphere> balls);
    /// Returns the union of other balls. Balls at the same place in the list that meet no changed ball keep their
    /// parts: bitwise equal, and quick where few balls change.
    UnionParts with(std::vector<Sphere> balls) const;

    /// Returns the volume, m³.
    double volume() const;

    /// Two balls in the place of one: the second becomes the last. It keeps the parts that volume_with() computed.
    struct Split {
        std::size_t ball;
        Sphere first, second;
        std::vector<std::pair<std::uint32_t, std::optional<ExposedPart>>> known{}; ///< ascending by ball

        /// Drops what is no longer known after these balls came or went. A ball that keeps its part keeps its place.
        void forget(const UnionParts& now, std::span<const Sphere> changed);
    };
    /// Returns the volume after a split: bitwise that of with() the same balls.
    double volume_with(Split& split) const;

private:
    UnionParts() = default;
    template <class BallAt, class PartAt> static double volume_of(std::size_t count, BallAt ball, PartAt part);

    std::vector<Sphere> balls_;
    std::vector<std::optional<ExposedPart>> parts_; ///< nothing: another ball contains the whole ball
};

} // namespace geometry
} // namespace foam
