// How the spheres become fewer and better.
#pragma once

#include "columns.hpp"

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

using Corners = std::array<Vec3, 3>;

/// A surface as triangles, and dense points on it that represent it in searches.
class Uncovered {
public:
    /// Keeps the points. `surface` must outlive this object.
    Uncovered(std::span<const Corners> surface, std::span<const Vec3> points)
        : surface_(surface), points_(points.begin(), points.end()), triangle_holder_(surface.size(), 0),
          point_holder_(points.size(), 0) {}

    /// Returns a few of the points that `balls[index]` must contain, because no other ball does or is nearer to them.
    /// For any centre within `shift` of the ball's, the farthest of them is as far as the farthest of all, up to the
    /// share `tolerance` of the radius. Empty if the ball is redundant.
    std::vector<Vec3> needed(std::span<const Sphere> balls, std::size_t index, double shift, double tolerance);

    /// Adds missed points: for each ball the farthest place of the surface that no other ball contains. Exact except
    /// for pieces of triangles smaller than `resolution`: such a piece in no single ball belongs to the ball that has
    /// to grow least for it. Returns the largest share of its radius by which a ball falls short.
    double add_missed(std::span<const Sphere> balls, double resolution);

    /// Returns the balls grown until they contain what add_missed() finds; centres stay.
    std::vector<Sphere> closed(std::vector<Sphere> balls, double resolution);

private:
    std::optional<Vec3> missed(std::span<const Sphere> balls, std::size_t index, double resolution);

    std::span<const Corners> surface_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> triangle_holder_, point_holder_; ///< the last ball that contained it
};

constexpr double surface_resolution = 4e-3; ///< of pieces of the surface, in units of its extent

struct SimplexOptions {
    int sweeps = 4;           ///< at most, over many balls
    int settlings = 24;       ///< of single balls, at most, over few
    int evaluations = 48;     ///< of the cost, per ball and sweep
    double least_gain = 2e-3; ///< the last sweep lowers the cost by a smaller share …
    double shortfall = 1e-3;  ///< … and leaves no ball short of its required reach by more than this share
};
/// Improves ball by ball: the centre moves downhill, and the radius is the least that contains what no other ball does
/// (Bradshaw and O'Sullivan 2004, section 6). A redundant ball stays unchanged.
std::vector<Sphere> simplex(std::vector<Sphere> balls, Uncovered& surface, const Columns& columns,
                            const SimplexOptions& options, Context& context);

/// Removes balls that the others can replace, as long as the cost rises by at most the share `excess` of the balls'
/// volume (Bradshaw and O'Sullivan 2004, section 6).
std::vector<Sphere> balance(std::span<const Vec3> points, std::vector<Sphere> balls, double excess,
                            const Columns& columns, Context& context);

struct DescentOptions {
    int steps = 120;
    std::size_t directions = 42; ///< points of a sphere on which its exposed area is measured
};

/// Improves all centres and radii at once, by descent on the volume outside the solid with a penalty on points in no
/// ball. Variational: the shape derivative of that volume is the exposed area (the objective is that of Wang et al.
/// 2006, "Variational sphere set approximation for solid objects"). The result contains all points.
std::vector<Sphere> variational(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns,
                                const DescentOptions& options, Context& context);

// From many medial spheres to few (Bradshaw and O'Sullivan 2004, section 5). All reductions return balls that contain
// the given cover points; the cost (Columns::outside) decides which result is best.

/// Returns for each point the ball that it is nearest to or deepest in: least |p − c| − r.
std::vector<std::uint32_t> assign(std::span<const Vec3> points, std::span<const Sphere> balls);
/// Returns the points of each ball.
std::vector<std::vector<Vec3>> grouped(std::span<const Vec3> points, std::span<const std::uint32_t> owner,
                                       std::size_t count);
/// Alternates assignment of points to balls and enclosing balls of the assigned points (Lloyd's scheme on balls; Wang
/// et al. 2006, section 4.1) for some rounds. Returns the balls of the least cost. Balls that lose all points get part
/// of the ball with the largest cost.
std::vector<Sphere> fitted(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns, int rounds);

/// Expand: all medial spheres extend beyond the surface by the same stand-off; greedily chooses those with most points
/// that are not covered yet; finds the least stand-off for which `count` spheres suffice.
class Expand {
public:
    Expand(std::span<const Vec3> points, std::span<const Sphere> medial);
    /// Returns at most `count` balls; empty if there is no medial sphere.
    std::vector<Sphere> cover(std::size_t count);

private:
    using Chosen = std::vector<std::uint32_t>;
    Chosen greedy(double stand_off) const;

    std::size_t points_;
    std::vector<Sphere> medial_;
    std::vector<float> gap_; ///< of point p to medial sphere m at [m · points + p]: how far p is outside
    double greatest_ = 0;    ///< stand-off for which one sphere suffices
    std::map<double, Chosen> known_;
};

/// Merge: unites the pair of neighbours with the least cost, from `balls` down to one. Element n − 1: the remaining n
/// balls.
std::vector<std::vector<Sphere>> merge(std::span<const Vec3> points, std::span<const Sphere> balls,
                                       const Columns& columns, Context& context);

/// Burst: removes the ball whose points add the least cost to its neighbours, down to `count`.
std::vector<Sphere> burst(std::span<const Vec3> points, std::vector<Sphere> balls, std::size_t count,
                          const Columns& columns, Context& context);

/// Divides the points by planes, each time where it saves most, without a medial axis. Element n − 1: n enclosing
/// balls. Ends early where points cannot be separated.
std::vector<std::vector<Sphere>> divide(std::span<const Vec3> points, std::size_t count, const Columns& columns,
                                        Context& context);

/// Returns points inside the solid on a grid of about `count` points over the box of `points`, each with its distance
/// to the nearest of them as the radius; and some of the points themselves, of radius 0, for solids too thin for the
/// grid.
std::vector<Sphere> grid_seeds(std::span<const Vec3> points, const Columns& columns, std::size_t count);
/// Returns the seeds that contain one of the points, or nearly.
std::vector<Sphere> touching_seeds(std::span<const Sphere> seeds, std::span<const Vec3> points);

/// Spawning: all spheres extend beyond the surface by the same stand-off. The next sphere starts from the seed with
/// most points that are not covered yet, and moves to where it contains more. Finds the least stand-off for which
/// `count` spheres suffice.
class Spawn {
public:
    /// Prepares the search. `most`: the largest count that is requested later.
    Spawn(std::span<const Vec3> points, std::span<const Sphere> seeds, const Columns& columns, std::size_t most);
    /// Returns at most `count` balls; empty if there is no seed.
    std::vector<Sphere> cover(std::size_t count, Context& context);

private:
    std::vector<Sphere> placed(double stand_off, Context& context) const;
    Sphere moved(const Sphere& start, double stand_off, std::span<const Vec3> open) const;
    double depth(const Vec3& p) const;

    std::vector<Vec3> points_;
    std::vector<Sphere> seeds_;
    const Columns& columns_;
    std::size_t most_;
    double greatest_ = 0; ///< stand-off for which one sphere suffices
    std::map<double, std::vector<Sphere>> known_;
};

} // namespace foam::medial
