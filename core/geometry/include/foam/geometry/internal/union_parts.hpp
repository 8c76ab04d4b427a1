// The volume of a union of balls, ball by ball.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

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
