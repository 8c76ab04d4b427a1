// Descents of all balls of a cover at once.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/measured/surface.hpp"
#include "by_spheres/moves/near_balls.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/power_cells.hpp"

#include <cmath>
#include <functional>

namespace foam::inline search::by_spheres {

/// Step lengths in units of the balls' mean radius at the start, falling geometrically from first to last.
class StepLengths {
public:
    StepLengths(const Balls& balls, int steps, float first, float last)
        : ratio_(steps > 1 ? std::pow(last / first, 1 / static_cast<float>(steps - 1)) : 1) {
        float size = 0;
        for (const Ball& ball : balls) {
            size += ball.r / static_cast<float>(balls.size());
        }
        length_ = first * size;
    }
    float now() const { return length_; }
    void advance() { length_ *= ratio_; }

private:
    float length_ = 0, ratio_;
};

/// The steps of a descent. Their lengths are in units of the balls' mean radius, falling geometrically from first to
/// last.
struct DescentPlan {
    int steps = 100;
    float first_step = 0.01f, last_step = 0.001f;
    int refresh = 10; ///< steps between two updates of the points that matter
};

/// Descent along the shape derivative (Wang et al. 2006 minimise the same excess volume): ∂ vol(U \ S) / ∂ r_i is the
/// area of ball i outside the other balls and outside S, ∂ / ∂ c_i the integral of the normal over it. Steps have even
/// length by moments (after Kingma and Ba 2015, with one scale for all balls). After each step, the least change of the
/// balls restores the points left outside to the balls in which they lie deepest: the projection onto linearised
/// constraints by Hildreth's method, force by force. A ball that gains little shrinks less, so points move to balls
/// where they cost less. Deterministic.
class Descent {
public:
    /// `directions`: sets that steps use in turn.
    Descent(const Occupancy& occupancy, const std::vector<Points>& directions)
        : occupancy_(occupancy), directions_(directions) {}

    /// Callback before every `plan.refresh`-th step. refresh(points, length) may change the points and where the balls
    /// are.
    using Refresh = std::function<void(Points& points, float length)>;
    void run(Points& points, Balls& balls, const DescentPlan& plan, const Refresh& refresh = {});

private:
    void add_exposed_areas(const Balls& balls, const Points& directions);
    /// Finds the balls in which the doubtful points lie deepest.
    void find_doubtful(const Points& points, const Balls& balls, float slack);
    /// Offers doubtful points of ball `i` to its neighbours, and leaves those far outside it to offer_far_out().
    void offer_near(std::size_t i, std::size_t begin, std::size_t end, const Balls& balls);
    /// Offers points far outside their ball, such as new ones, whose ball is not known yet.
    void offer_far_out(const Balls& balls);
    /// Offers doubtful points to the balls that come to within `gap` of ball `i`. A ball in which a point lies deeper
    /// than in ball `i` comes to within twice the point's distance outside ball `i`.
    void offer_within(float gap, std::size_t i, std::size_t begin, std::size_t end, const Balls& balls);
    /// Restores points that are outside; points nearer than `slack` to the outside become constraints.
    void hold(const Points& points, Balls& balls, float slack);
    void step(Balls& balls, float length);

    const Occupancy& occupancy_;
    const std::vector<Points>& directions_;
    NearBalls near_;
    Exposed exposed_;
    std::vector<std::uint32_t> owner_;
    std::vector<char> pressed_;
    std::vector<Held> held_;
    std::vector<Slope> slopes_, mean_;
    float square_ = 0, mean_scale_ = 1, square_scale_ = 1;
    // State of one call of hold(): points that may lie outside, by the ball that contained them last, and their indices
    // in `points`.
    std::vector<std::uint32_t> doubtful_index_, sorted_;
    std::vector<std::size_t> first_;   ///< start of each ball in these, and the end
    std::vector<std::size_t> far_out_; ///< doubtful points far outside their ball
    Points far_points_;
    Owners far_owners_; ///< of these
    std::vector<std::uint32_t> rivals_;
    Points doubtful_;
    Deepest deepest_;
};

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

/// A surface in small triangles, and points that represent it.
struct DescentSurface {
    FineSurface skin;
    Points some, most; ///< subsets of its points: for the first estimate, for a descent

    /// Makes a surface fine enough for `balls` balls.
    DescentSurface(const Solid& solid, const Frame& frame, std::size_t balls);
    /// Makes one of points without faces.
    DescentSurface(Points seen, std::size_t balls);
    static std::size_t pieces_for(std::size_t balls);
};

/// Directions in which descents compute the exposed surface of a ball; they are turned from step to step, so that none
/// is preferred.
const std::vector<Points>& directions_of_steps();

/// Returns the balls after a descent that uses the points that may come to lie outside, and those where balls meet.
/// Splits first add missing balls up to `count`. The result contains those points, not yet the surface.
Balls descended(const DescentSurface& surface, const Occupancy* occupancy, Balls balls, std::size_t count,
                const QuickDescentPlan& plan);

} // namespace foam::inline search::by_spheres
