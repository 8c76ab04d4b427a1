// Refinement of balls by descent: their union gets less excess volume and still covers the surface.
#pragma once

#include "cover/portfolio/claim.hpp"
#include "cover/measured/directions.hpp"
#include "cover/moves/exposed.hpp"
#include "cover/moves/held_points.hpp"
#include "cover/moves/near_balls.hpp"
#include "cover/starts/power_cells.hpp"
#include "cover/portfolio/problem.hpp"

#include <functional>

namespace foam::inline search::cover {

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

} // namespace foam::search::cover
