// Pieces of triangles and the balls that may contain them: shared by certificates and growth.
#pragma once

#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/surface_runs.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <span>
#include <vector>

namespace foam::inline geometry {

/// A triangle, or a part of it after halvings. For a polyhedron that approximates a curved primitive, it is a prism
/// between the polyhedron and the surface beneath it; the true surface lies within it. A part of a needle is a strip,
/// the hull of two segments; it is kept like a prism.
struct Piece {
    Corners corners;
    Corners beneath; ///< curved: straight down from the corners, on or under the true surface; else unused
    bool curved = false;
    std::uint32_t triangle = 0;
    std::uint32_t level = 0; ///< halvings so far
};

/// Returns the two halves, cut at the middle of the longest edge (Rivara 1984: the angles stay bounded). A prism that
/// is higher than that edge is cut at half its height. A triangle whose height is at
/// most a ten-thousandth of that edge becomes strips between its two long edges.
std::pair<Piece, Piece> halves(const Piece& piece);
/// The middle of a piece's triangle, and the radius of the piece about it.
struct PieceMiddle {
    Vec3 point;
    double radius;
};
PieceMiddle middle_of(const Piece& piece);
/// Returns the longest edge, or the height if that is greater.
double size_of(const Piece& piece);
/// Returns an upper bound of the distance between two points of the piece.
double diameter_of(const Piece& piece);

/// The points whose convex hull is the piece.
struct PiecePoints {
    explicit PiecePoints(const Piece& piece);
    const Vec3* begin() const { return points.data(); }
    const Vec3* end() const { return points.data() + count; }
    std::array<Vec3, 6> points;
    std::size_t count;
};

/// Returns the largest distance from a point to any point of the piece.
double reach(const Vec3& center, const Piece& piece);

/// A ball or capsule among the solid's parts: all points within `radius` of the segment between two points. The ball
/// around it is known in closed form, tighter than that around its tessellation.
struct RoundPart {
    std::uint32_t begin, end; ///< its triangles in the surface
    Vec3 from, to;            ///< relative to the surface's centre
    Vec3 center;              ///< in the solid's frame
    double radius;
};

/// Balls in coordinates relative to the surface's centre o, with radii reduced by more than all rounding errors.
///
/// Why no uncovered point passes (docs/dev/certificate.md has the argument step by step). Let u = 2^-53, M the largest
/// distance of a surface vertex from o, |c| that of a ball's centre, r its radius, L the most halvings. A vertex is off
/// by at most 8u·(M + |o|) from its place by the part's pose in exact arithmetic. Subtracting o rounds each coordinate
/// by at most u·M (u·|c|). Every halving rounds the middle by at most u·M and averages the errors of its ends, so a
/// corner of a piece is within (L + 1)·u·M of its exact place, in each coordinate; the exact pieces tile the triangle.
/// A cut at other shares, which add up to exactly 1, rounds by at most 2 u·M and counts as two halvings. The difference
/// of a coordinate to the ball's centre is then off by less than (L + 2)·u·M + 2u·|c|, the distance by √3 times that.
/// The rounding of the squares, their sum and the comparison adds less than 4u times the distance, which is at most r
/// when the test passes. The total is below 2u·(L + 8)·(M + |c| + r) + 16u·|o| = slack. So if the test against r -
/// slack passes, the exact corners lie in the exact ball, and by convexity so does the exact piece. The argument
/// requires squares that neither overflow nor underflow: balls too large or too small for that contain nothing.
class Balls {
public:
    /// `caution`: multiplies the slack. Balls that are not finite, or not larger than the slack, contain nothing. Keeps
    /// references into `solid`, which must outlive this.
    Balls(const Solid& solid, std::span<const Sphere> spheres, std::uint32_t most_halvings, double caution = 1);

    std::size_t size() const { return centers_.size(); }
    const Vec3& center(std::uint32_t i) const { return centers_[i]; }
    /// Returns the radius minus slack; a ball for which it is not above zero contains nothing; -infinity if the radius
    /// is not finite.
    double radius(std::uint32_t i) const { return radii_[i]; }
    /// Returns the radius with slack of a ball that just contains all points within `reach` of its centre: the inverse
    /// of radius().
    double full_radius(std::uint32_t i, double reach) const;
    /// Sets a new full radius. If it is not finite, the ball contains nothing.
    void set_radius(std::uint32_t i, double full_radius);

    bool holds(std::uint32_t i, const Piece& piece) const;
    bool holds(std::uint32_t i, const Vec3& p) const { return squared_norm(p - centers_[i]) <= limit(i); }
    /// Returns the squared distance from the centre minus the squared radius: negative inside.
    double power(std::uint32_t i, const Vec3& p) const { return squared_norm(p - centers_[i]) - radii_[i] * radii_[i]; }
    const std::vector<RoundPart>& round_parts() const { return round_parts_; }
    /// Returns the full radius with which ball `i` contains the part: rounded up, but exact for a ball about the same
    /// centre.
    double radius_around(std::uint32_t i, const RoundPart& part) const;
    /// Returns whether one ball contains the part.
    bool held(const RoundPart& part) const;
    /// Returns how far `p` is outside ball `i`; negative inside.
    double gap(std::uint32_t i, const Vec3& p) const { return distance(p, centers_[i]) - radii_[i]; }

    /// Appends to `result` the balls that may be nearest to some point of the piece, or may contain it. Ball i is left
    /// out only if another ball j is so much nearer (|p - c_j| - r_j < |p - c_i| - r_i for every p of the piece) that j
    /// contains everything that i contains. The ball nearest to the piece's middle comes first. Returns the largest gap
    /// at the piece's middle of a ball that is not left out.
    double candidates(const Piece& piece, std::vector<std::uint32_t>& result) const;
    /// Appends the same, choosing from result[begin, end), which is not empty.
    double candidates(const Piece& piece, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& result) const;

    /// Returns whether ball `i` contains all triangles of a run: holds() of each is true then.
    bool holds(std::uint32_t i, const SurfaceRuns::Run& run) const {
        constexpr double rounding = 1e-12; // more than that of the distances here and in the test of each corner
        return distance(run.center, centers_[i]) + run.radius <= radii_[i] * (1 - rounding) && limit(i) > 0;
    }
    /// Returns the triangles that no single ball contains, and all of curved primitives, ascending. What the balls
    /// contain in whole runs takes no time.
    std::vector<std::uint32_t> open_triangles() const;
    const SurfaceRuns& runs() const { return *runs_; }

    /// Returns triangle `i` of the surface, relative to the centre.
    Piece piece(std::uint32_t i) const;
    std::size_t piece_count() const { return triangles_->size(); }
    Vec3 to_solid(const Vec3& p) const { return p + origin_; }
    double extent() const { return extent_; }

private:
    double slack(double center_norm, double radius) const;
    double shrunk(std::uint32_t i, double full_radius) const;
    Corners corners(std::uint32_t i) const {
        const auto& [a, b, c] = (*triangles_)[i];
        return {(*vertices_)[a] - origin_, (*vertices_)[b] - origin_, (*vertices_)[c] - origin_};
    }
    /// Returns the ball that comes nearest to a point; size() if there is none.
    std::uint32_t nearest_to(const Vec3& p) const;
    /// Calls take(i) for the balls whose gap at `p` may be at most `limit`, which take() may lower, the near ones
    /// first.
    template <class Take> void visit_near(const Vec3& p, const double& limit, Take take) const;
    /// Returns whether one ball contains a run; `last`: the one that contained the run before, tried first. `near`: if
    /// none does, the balls that may contain some of it.
    bool any_holds(const SurfaceRuns::Run& run, std::uint32_t& last, std::vector<std::uint32_t>& near) const;
    void update_largest();
    void find_round_parts(const Solid& solid);
    void find_beneath(const Solid& solid, std::size_t part);
    bool holds(std::uint32_t i, const Corners& corners) const;
    /// Returns the squared radius within which the ball contains a point; negative if the ball contains nothing.
    double limit(std::uint32_t i) const;

    Vec3 origin_;
    double extent_;    // M
    double unit_;      // 2u·(L + 8)·caution
    double placement_; // 16u·|o|·caution
    const std::vector<Triangle>* triangles_;
    const std::vector<Vec3>* vertices_; // in the solid's frame
    const SurfaceRuns* runs_;
    std::vector<Corners> beneath_; // of each triangle; empty if no part is curved
    std::vector<char> curved_;
    std::vector<Vec3> centers_;
    std::vector<double> radii_;
    std::vector<Vec3> given_centers_; // in the solid's frame
    std::vector<double> full_radii_;
    std::vector<RoundPart> round_parts_;
    Bvh bvh_;                     // over the centres
    std::vector<double> largest_; // radius below each node
};

} // namespace foam::geometry
