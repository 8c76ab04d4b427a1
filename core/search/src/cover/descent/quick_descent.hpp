// Refinement of balls by a descent that takes milliseconds: their union shrinks and still covers points.
#pragma once

#include "cover/moves/exposed.hpp"
#include "cover/moves/held_points.hpp"
#include "cover/measured/occupancy.hpp"
#include "cover/starts/power_cells.hpp"

#include <functional>

namespace foam::inline search::cover {

/// The steps of a descent. Their lengths are in units of the balls' mean radius, falling geometrically from first to
/// last.
struct QuickDescentPlan {
    int steps;
    float first_step, last_step;
    int refresh; ///< steps between two updates of the points that matter
};

/// Descent along the shape derivative of vol(U): by r_i it is the area of ball i outside the others, by c_i the
/// integral of the normal over it. For balls that cover a solid vol(U) - vol(S) is the excess volume, so the solid
/// itself need not be queried; for many balls, which may leave a cavity in it, only the area outside the solid counts.
/// Steps have momentum and one scale for all balls (Kingma and Ba 2015 have one for each number). Where two balls meet,
/// the one with the greater excess volume for containing a point shrinks more, and the other takes over the point.
/// After each step the least change restores the points left outside: the projection onto linearised constraints by
/// Hildreth's method, force by force. Deterministic.
class QuickDescent {
public:
    /// `directions`: sets that steps use in turn. `occupancy`: of the solid; null: the solid is not used.
    QuickDescent(const std::vector<Points>& directions, const Occupancy* occupancy)
        : directions_(directions), occupancy_(occupancy) {}

    /// Callback before every few steps, which sets the points that matter. refresh(balls, points, reach): points deeper
    /// inside than `reach` do not matter until the next call.
    using Refresh = std::function<void(const Balls& balls, Points& points, float reach)>;
    void run(Balls& balls, const QuickDescentPlan& plan, const Refresh& refresh);

private:
    void find_slopes(const Balls& balls, const Points& directions);
    /// Computes, for each direction of a ball's last look, the exposed share.
    void find_shows(const Ball& ball, const Points& directions);
    void step(Balls& balls, float length);
    void hold(const Points& points, Balls& balls, float slack);

    const std::vector<Points>& directions_;
    const Occupancy* occupancy_;
    Exposed exposed_;
    Owners owners_;
    std::vector<float> shows_;
    std::vector<Slope> slopes_, mean_;
    float square_ = 0, mean_scale_ = 1, square_scale_ = 1;
    std::vector<char> pressed_;
    std::vector<Held> held_;
};

} // namespace foam::search::cover
