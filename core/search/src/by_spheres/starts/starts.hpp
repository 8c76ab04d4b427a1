// Covers to begin with.
#pragma once

#include "by_spheres/descent/ball_cost.hpp"
#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/power_cells.hpp"

#include <foam/base/random.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace foam::inline search::by_spheres {

/// Returns points that represent the solid: on its surface and inside it.
Points body_points(const Problem& problem, std::size_t count);

/// Returns `count` clusters of the points: random seeds far apart (Arthur and Vassilvitskii 2007, "k-means++"), then a
/// few rounds of Lloyd; one ball about the centroid of each.
Balls clusters(const Points& points, std::size_t count, Random& random);

/// Cuts the points' box along the axes into equal cells and returns a ball about the points in each; empty cells are
/// left out.
Balls grid(const Points& points, const std::array<Vec3, 3>& axes, const std::array<std::size_t, 3>& counts);
/// Returns the numbers of cells along the axes, `count` in all, that make the smallest cells.
std::array<std::size_t, 3> most_cubic(const Points& points, const std::array<Vec3, 3>& axes, std::size_t count);

/// Returns the axes of the points' second moments, longest extent first.
std::array<Vec3, 3> axes_of(const Points& points);

/// Returns the balls with two in place of ball `i`: clusters of the points that lie deepest in it. Returns the same
/// balls if there are too few points. `gaps`: how far each point lies outside the balls, at most.
Balls split(const Balls& balls, std::size_t i, const Points& points, const std::vector<float>& gaps, Random& random);

/// Returns grids of `count` cells or fewer along the frame's axes and along the points' own: nearly cubic cells, and a
/// row where it is not too long.
std::vector<Balls> grids(const Points& points, std::size_t count, std::size_t most_in_a_row);

/// Returns balls about the points, `count` of them if there are enough points. Repeatedly, the ball whose split saves
/// most volume is replaced by the smallest balls of the two parts into which a plane cuts its points. `balls`: the
/// start; if empty, the smallest ball around all points. New balls satisfy the limits where they can.
Balls divided(const Points& points, Balls balls, std::size_t count, const Limits& limits = {});

/// Returns at most `count` balls about nodes of the field, each dilated by the same length, the least by which they
/// contain the points: about a node of depth d the ball has the radius d + length. A greedy cover tests whether a
/// length is sufficient, always with the ball that contains most of the remaining points (Stolpner, Kry and Siddiqi
/// 2011 dilate medial balls; Wang et al. 2024, "Coverage Axis++", choose among inner balls greedily), and the length is
/// bisected. Empty if only one ball about the points is found.
Balls dilated_inner_balls(const DistanceField& field, const Points& points, std::size_t count);

/// Points outside the active set of a descent. Only few of many points ever matter to a descent; the others are checked
/// now and then (active sets).
class WaitingPoints {
public:
    /// `begin`: the first of `all` that is not among the descent's points from the start. `all` must outlive this.
    WaitingPoints(const Points& all, std::size_t begin);

    /// Moves the points outside all balls to `active`.
    void add_outside(const Balls& balls, Points& active);

private:
    struct Waiting {
        std::uint32_t point, owner; ///< the last ball that contained it
    };
    std::optional<std::uint32_t> owner_of(const Waiting& waiting, const Balls& balls) const;

    const Points& all_;
    std::vector<Waiting> waiting_;
};

/// Returns the middles of the pieces that no single ball contains, with edges of about `finest` (unit frame). They
/// concentrate where the surface runs through the creases between balls, and where it extends beyond them. At most
/// `most`.
Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most);

/// The conditional gradient method (Frank and Wolfe 1956). The balls (centre, radius) that contain a set are a convex
/// set, as |p - c| - r is a convex function. Over it the excess volume of a ball is, to first order, least at the
/// tilted enclosing ball. All balls move part of the way towards theirs, by a line search: an interpolation of two
/// balls that contain a part contains it too. Before each step the surface is divided anew, which keeps the balls
/// covering: a ball contains its power cell if all together cover the surface. The tilted ball itself is too far where
/// only a small part of a ball is exposed: a half-space would best contain a flat face.
class ConditionalGradient {
public:
    /// Both must outlive this.
    ConditionalGradient(const FineSurface& skin, const Occupancy& occupancy);

    /// Returns the best balls of at most `steps` steps, fewer if they bring no improvement. All of them cover the
    /// surface, whatever the given balls do. The volume is that of the balls and the solid together.
    CoverCandidate improved(Balls balls, int steps);

private:
    double claim(const Balls& balls);
    /// Returns the tilt of the surface exposed outside the solid, with EnclosingBall's signs.
    Vec3 tilt(const Balls& balls, std::size_t i);
    /// Sizes each ball to contain its part.
    void hold_parts(Balls& balls) const;
    Balls towards(const Balls& balls);
    /// Returns the best of `balls` and the points up to `share` of the way to `end`; sets the share it moved, or 0.
    CoverCandidate line_search(const CoverCandidate& balls, const Balls& end, double& share);

    const Occupancy& occupancy_;
    PowerCells cells_;
    Points inside_;
    double inside_volume_; ///< volume of the solid per point of inside_, units³
    EnclosingBall enclosing_ball_;
    Exposed exposed_;
    Owners owners_;
};

/// Covering balls, the cost of each, and the largest cost.
struct Minimax {
    Balls balls;
    std::vector<double> costs;
    double worst = 0;

    std::size_t dearest() const;
};

/// Lloyd's iteration (1982) for the maximum instead of the mean. All balls grow until they cost as much as the most
/// expensive one, the surface is divided among them by power, and the cheapest ball that contains its part replaces
/// each. As the grown balls contain their parts, the largest cost never rises. With the radius as cost, these are the
/// alternating steps of the k-centre problem, with smallest enclosing balls of Voronoi cells.
class MinimaxSearch {
public:
    /// Both must outlive this.
    MinimaxSearch(const FineSurface& skin, const BallCost& cost) : cells_(skin), cost_(cost) {}

    /// Returns covering balls, at most `count`. Balls without a part move to the most expensive ball.
    Minimax improved(const Balls& start, std::size_t count, int rounds);
    /// Returns the result with ball `i` removed and the most expensive ball split in two.
    Minimax moved(const Minimax& cover, std::size_t i, int rounds);
    /// Returns balls of the same cost and less volume: they tilt where that reduces it, as long as none costs more than
    /// the most expensive ball.
    Minimax leaner(const Minimax& cover, const Points& directions, int rounds);

private:
    Minimax fitted(const Balls& balls);
    Balls grown(const Minimax& cover) const;
    /// Returns the balls with the most expensive one split in two.
    Balls with_split(const Minimax& cover);

    PowerCells cells_;
    const BallCost& cost_;
};

} // namespace foam::inline search::by_spheres
