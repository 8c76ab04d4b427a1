// A surface shared among balls: the restricted power diagram.
#pragma once

#include "cover/exposed.hpp"
#include "cover/fine_skin.hpp"
#include "cover/limits.hpp"

namespace foam::cover {

/// For each of some points the ball of least power |p - c|² - r², and that power.
struct Owners {
    std::vector<float> power;
    std::vector<std::uint32_t> owner;

    void find(const Points& points, const Balls& balls);
};

/// Each ball's part of a surface: where its power is least (Aurenhammer 1987). The planes between the cells are those
/// of the circles in which balls meet. Faces are cut at them, and each piece goes to a cell by its extreme points:
/// balls that hold these hold the surface, whatever the cells are, for balls are convex. So balls about their parts are
/// a cover by construction. Between two cells of three in a small face a third may run: then the pieces overlap.
class PowerCells {
public:
    /// The skin must outlive this. Balls that are fitted keep to the limits where they can.
    explicit PowerCells(const FineSkin& skin, Limits limits = {}) : skin_(skin), enclosing_ball_(std::move(limits)) {}

    /// Looks who owns which points, and where edges pass from one to the other.
    void find(const Balls& balls);
    /// Points of the skin and their owners; points where the last balls' cells meet.
    const FineSkin& skin() const { return skin_; }
    const Owners& owners() const { return owners_; }
    const Points& borders() const { return borders_; }

    /// Gives each ball its part of the surface; balls without one are left out.
    Balls shared(const Balls& balls);
    /// Each ball made to fit the part that it has: of all that hold it, to first order, the one by which the union
    /// claims least. `directions` are asked what shows of a ball. Balls without a part are
    /// left out.
    Balls fitted(const Balls& balls, const Points& directions);
    /// Extreme points of what each of the balls shared or fitted last has to hold.
    const std::vector<Points>& parts() const { return parts_; }

private:
    /// Point on the segment where the powers of two balls are equal.
    static Vec3 crossing(const Vec3& from, const Vec3& to, const Ball& a, const Ball& b);
    void cut(const std::array<std::uint32_t, 3>& face, const Balls& balls);
    void cut_edge(std::uint32_t from, std::uint32_t to, const Balls& balls);
    void add_border(const Vec3& point, std::uint32_t a, std::uint32_t b);
    void hand_out(std::size_t balls);

    const FineSkin& skin_;
    Owners owners_;
    Points borders_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_; ///< of each point at a border, the cells
    std::vector<Points> parts_;
    std::vector<std::array<double, 2>> lines_; ///< of each ball along an edge: see cut_edge
    LimitedBall enclosing_ball_;
    Exposed exposed_;
};

} // namespace foam::cover
