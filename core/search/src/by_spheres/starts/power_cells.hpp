// The division of a surface among balls: the restricted power diagram.
#pragma once

#include "by_spheres/measured/surface.hpp"
#include "by_spheres/moves/near_balls.hpp"
#include "by_spheres/portfolio/problem.hpp"

namespace foam::inline search::by_spheres {

/// For each point, the ball of least power |p - c|² - r², and that power.
struct Owners {
    std::vector<float> power;
    std::vector<std::uint32_t> owner;

    void find(const Points& points, const Balls& balls);
    /// Finds them anew after a change of two balls, of which one may be a new one. Linear in the number of points.
    /// Returns the indices of the points that belonged to the two or belong to them now.
    std::vector<std::uint32_t> update(const Points& points, const Balls& balls, std::size_t one, std::size_t other);
};

/// The parts of a surface that belong to each ball: where its power is least (Aurenhammer 1987). The planes between the
/// cells are those of the circles in which balls meet. Faces are cut at them, and each piece is assigned to a cell by
/// its extreme points. Balls that contain these points cover the surface, whatever the cells are, as balls are convex.
/// So balls about their parts cover by construction. Between two cells of three in a small face a third may run: then
/// the pieces overlap.
class PowerCells {
public:
    /// The skin must outlive this. Fitted balls satisfy the limits where they can.
    explicit PowerCells(const FineSurface& skin, Limits limits = {})
        : skin_(skin), enclosing_ball_(std::move(limits)) {}

    /// Which points on the borders between cells are found: on each edge of the skin, or only those that may be extreme
    /// points of a part. Within a triangle of the surface a border is straight, so its ends are enough.
    enum class Borders { all, extreme };
    /// Finds the owners of points, and where edges pass from one owner to another.
    void find(const Balls& balls, Borders which);
    /// The skin; the owners of its points and the points where the last balls' cells meet follow.
    const FineSurface& skin() const { return skin_; }
    const Owners& owners() const { return owners_; }
    const Points& borders() const { return borders_; }

    /// Assigns to each ball its part of the surface. Returns the balls that have one.
    Balls shared(const Balls& balls);
    /// Fits each ball to its part: of all balls that contain it, to first order, the one that gives the union the least
    /// excess volume. Returns the balls that have a part. `directions`: for the exposed surface of a ball.
    Balls fitted(const Balls& balls, const Points& directions);
    /// The part of each ball shared or fitted last, by points whose convex hull contains it.
    const std::vector<Points>& parts() const { return parts_; }

private:
    /// Returns the point on the segment where the powers of two balls are equal.
    static Vec3 crossing(const Vec3& from, const Vec3& to, const Ball& a, const Ball& b);
    void cut(const std::array<std::uint32_t, 3>& face, unsigned own_edges, const Balls& balls);
    void cut_edge(std::uint32_t from, std::uint32_t to, const Balls& balls);
    void add_border(const Vec3& point, std::uint32_t a, std::uint32_t b);
    void hand_out(std::size_t balls);

    const FineSurface& skin_;
    Owners owners_;
    Points borders_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_; ///< for each point at a border, its cells
    std::vector<Points> parts_;
    std::vector<std::array<double, 2>> lines_; ///< for each ball along an edge: see cut_edge
    LimitedBall enclosing_ball_;
    Exposed exposed_;
};

} // namespace foam::search::by_spheres
