// Balls moved and sized so that their union becomes smaller and still holds points: the descent of an effort that has
// milliseconds.
#pragma once

#include "cover/exposed.hpp"
#include "cover/held_points.hpp"
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
/// integral of the normal over it. For balls that hold a solid's surface vol(U) - vol(S) is what they claim outside, so
/// the solid itself is not asked. Steps have momentum and one scale for all balls (Kingma and Ba 2015 have one for each
/// number): where two balls meet, the one that claims more by holding a point falls back farther, and the other takes
/// the point. After each step points left outside are taken back in by the least change: the projection onto linearised
/// constraints by Hildreth's method, force by force. Deterministic.
class QuickDescent {
public:
    /// `directions`: sets that steps take in turn.
    explicit QuickDescent(const std::vector<Points>& directions) : directions_(directions) {}

    /// `refresh(balls, points, reach)` is called before every so many steps, and may change both; points deeper inside
    /// than `reach` will not matter until the next time. There must be points then.
    using Refresh = std::function<void(Balls& balls, Points& points, float reach)>;
    void run(Balls& balls, const QuickDescentPlan& plan, const Refresh& refresh);

private:
    struct Slope {
        float x = 0, y = 0, z = 0, r = 0;
    };
    void find_slopes(const Balls& balls, const Points& directions);
    void step(Balls& balls, float length);
    void hold(const Points& points, Balls& balls, float slack);

    const std::vector<Points>& directions_;
    Exposed exposed_;
    Owners owners_;
    std::vector<Slope> slopes_, mean_;
    float square_ = 0, mean_scale_ = 1, square_scale_ = 1;
    std::vector<char> pressed_;
    std::vector<Held> held_;
};

} // namespace foam::cover
