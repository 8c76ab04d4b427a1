// The part of the surface that a ball must contain because no other does.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

using Corners = std::array<Vec3, 3>;

/// A surface as triangles, and dense points on it that represent it in searches.
class Uncovered {
public:
    /// Keeps the points. `surface` must outlive this object.
    Uncovered(std::span<const Corners> surface, std::span<const Vec3> points)
        : surface_(surface), points_(points.begin(), points.end()), triangle_holder_(surface.size(), 0),
          point_holder_(points.size(), 0) {}

    /// Returns a few of the points that `balls[index]` must contain, because no other ball does or is nearer to them.
    /// For any centre within `shift` of the ball's, the farthest of them is as far as the farthest of all, up to the
    /// share `tolerance` of the radius. Empty if the ball is redundant.
    std::vector<Vec3> needed(std::span<const Sphere> balls, std::size_t index, double shift, double tolerance);

    /// Adds missed points: for each ball the farthest place of the surface that no other ball contains. Exact except
    /// for pieces of triangles smaller than `resolution`: such a piece in no single ball belongs to the ball that has
    /// to grow least for it. Returns the largest share of its radius by which a ball falls short.
    double add_missed(std::span<const Sphere> balls, double resolution);

    /// Returns the balls grown until they contain what add_missed() finds; centres stay.
    std::vector<Sphere> closed(std::vector<Sphere> balls, double resolution);

private:
    std::optional<Vec3> missed(std::span<const Sphere> balls, std::size_t index, double resolution);

    std::span<const Corners> surface_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> triangle_holder_, point_holder_; ///< the last ball that contained it
};

} // namespace foam::medial
