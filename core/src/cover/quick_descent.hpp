// Balls moved and sized so that their union becomes smaller and still holds points: the descent of an effort that has
// milliseconds.
#pragma once

#include "cover/exposed.hpp"
#include "cover/held_points.hpp"
#include "cover/occupancy.hpp"
#include "cover/power_cells.hpp"

#include <functional>

namespace foam::cover {

/// Lengths of steps are in units of the balls' mean radius, falling from first to last geometrically.
struct QuickDescentPlan {
    int steps;
    float first_step, last_step;
    int refresh; ///< steps between two looks at which points matter
};

/// Descent along the shape derivative of vol(U): by r_i it is the area of ball i outside the others, by c_i the
/// integral of the normal over it. For balls that hold a solid vol(U) - vol(S) is what they claim outside, so the solid
/// itself need not be asked; of many balls, which may leave a hollow in it, only what lies outside counts. Steps have
/// momentum and one scale for all balls (Kingma and Ba 2015 have one for each number): where two balls meet, the one
/// that claims more by holding a point falls back farther, and the other takes the point. After each step points left
/// outside are taken back in by the least change: the projection onto linearised constraints by Hildreth's method,
/// force by force. Deterministic.
class QuickDescent {
public:
    /// `directions`: sets that steps take in turn. `occupancy`: of the solid; none: it is not asked.
    QuickDescent(const std::vector<Points>& directions, const Occupancy* occupancy)
        : directions_(directions), occupancy_(occupancy) {}

    /// `refresh(balls, points, reach)` is called before every so many steps for the points that matter; those deeper
    /// inside than `reach` will not until the next time.
    using Refresh = std::function<void(const Balls& balls, Points& points, float reach)>;
    void run(Balls& balls, const QuickDescentPlan& plan, const Refresh& refresh);

private:
    void find_slopes(const Balls& balls, const Points& directions);
    /// Of each direction of a ball's last look the share that shows outside.
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

} // namespace foam::cover
