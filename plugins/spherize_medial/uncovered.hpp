// What of the surface a ball must hold because no other does.
#pragma once

#include <foam/sphere.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

using Corners = std::array<Vec3, 3>;

/// A surface in its triangles, and points close together on it that stand for it while much is tried.
class Uncovered {
public:
    /// `surface` must outlive this.
    Uncovered(std::span<const Corners> surface, std::span<const Vec3> points)
        : surface_(surface), points_(points.begin(), points.end()), triangle_holder_(surface.size(), 0),
          point_holder_(points.size(), 0) {}

    /// Of the points that `balls[index]` must hold, because no other ball does or is nearer to them, a few: for any
    /// centre within `shift` of the ball's, the farthest of them is as far as the farthest of all, up to the share
    /// `tolerance` of the radius. Empty if the others do without the ball.
    std::vector<Vec3> needed(std::span<const Sphere> balls, std::size_t index, double shift, double tolerance);

    /// Looks for what the points miss: of the surface that no other ball holds, the place farthest from each ball joins
    /// the points. Exact but for pieces of triangles smaller than `resolution`: one of these that no single ball holds
    /// is the duty of the ball that has to grow least for it. Answers the largest share of its radius by which a ball
    /// falls short.
    double add_missed(std::span<const Sphere> balls, double resolution);

    /// The balls grown until they hold what add_missed() looks for; centres stay.
    std::vector<Sphere> closed(std::vector<Sphere> balls, double resolution);

private:
    std::optional<Vec3> missed(std::span<const Sphere> balls, std::size_t index, double resolution);

    std::span<const Corners> surface_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> triangle_holder_, point_holder_; ///< the ball that held it when it was last asked
};

} // namespace foam::medial
