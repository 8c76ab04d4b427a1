// The moves that change a cover and keep it one.
#pragma once

#include "by_spheres/descent/descent.hpp"
#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/surface.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"
#include "by_spheres/starts/power_cells.hpp"
#include "by_spheres/starts/two_balls.hpp"

#include <foam/base/random.hpp>

#include <functional>
#include <optional>

namespace foam::inline search::by_spheres {

struct ExchangePlan {
    TwoBallSearch::Plan split;
    int evaluations; ///< evaluations for two balls that meet
    int rounds;      ///< rounds over the balls whose neighbours have changed
    int cells;       ///< cells of the lattice on which volumes are compared
};

/// Balls that together cover a skin. Two balls that meet exchange pieces across a plane; neither needs to contain
/// pieces that other balls also contain.
class Exchange {
public:
    /// Precondition: `balls` cover the skin. The problem and the skin must outlive this.
    Exchange(const Problem& problem, const IndexedSurface& skin, const ExchangePlan& plan, Balls balls);

    const Balls& balls() const { return balls_; }
    /// Replaces the balls; where few of them change, little is computed again.
    void take(const Balls& balls);
    /// A look at the splits of a ball.
    struct Look {
        double gain;                  ///< of the best one, units³; infinitely bad if there is none
        std::vector<TwoBalls> starts; ///< the best first
        /// The look is the same while no ball comes or goes that meets this one.
        Ball reach;
    };
    Look look_at_splits(std::size_t ball);
    /// Returns the best split of a ball after a look with starts; nothing if there is none.
    std::optional<std::array<Ball, 2>> best_split(std::size_t ball, const std::vector<TwoBalls>& starts);
    /// Splits the one of the named balls whose split gains most. Returns false if none can be split.
    bool split(const std::vector<std::size_t>& candidates);
    /// Exchanges pieces until nothing changes, or for the plan's rounds.
    void settle();

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    bool meet(std::size_t i, std::size_t j) const;
    /// Finds the pieces that balls i and j must contain, and their surroundings.
    void look_at(std::size_t i, std::size_t j, const Ball& region);
    /// Finds the pieces that a ball alone contains, and its surroundings.
    void look_at(std::size_t ball);
    /// Finds the balls but i and j that meet another.
    void find_others(std::size_t i, std::size_t j, const Ball& reach);
    bool exchange(std::size_t i, std::size_t j);
    void find_homes();
    std::uint32_t home_of(const IndexedSurface::Face& face, std::span<const std::uint32_t> balls) const;
    void find_near(std::span<const IndexedSurface::Face> faces, const std::vector<std::uint32_t>& from,
                   std::vector<std::uint32_t>& near) const;
    bool holds(const Ball& ball, const IndexedSurface::Face& face) const;

    const IndexedSurface& skin_;
    ExchangePlan plan_;
    Balls balls_;
    std::vector<std::uint32_t> home_;                    ///< for each face a ball that contains it alone, or none
    std::vector<std::uint32_t> all_, near_, moved_near_; ///< balls
    Remainder remainder_;
    OutsideVolume outside_;
    std::vector<std::uint32_t> moved_; ///< balls that moved since homes were found, ascending
    Content content_;
    std::vector<std::uint32_t> faces_;
    Balls others_;
    Ball reach_{}; ///< of the last look: around the balls and all pieces that matter to them
};

/// Returns the indices of the values, that of the largest first, of equal ones in order.
std::vector<std::size_t> by_falling(const std::vector<double>& values);

class Improvement {
public:
    /// `directions`: per ball. The problem must outlive this.
    Improvement(const Problem& problem, std::size_t directions, std::size_t first_points);

    /// Returns the refined balls. `creases`: include points between balls. The balls contain the points of the last
    /// update, not yet the whole surface.
    Balls improved(Balls balls, const DescentPlan& plan, bool creases) const;
    /// Returns a measure of the excess volume of a ball outside the others. Only balls that meet it matter.
    double waste(const Balls& balls, std::size_t i) const;
    /// Returns the indices of the balls, the one with most excess volume first.
    std::vector<std::size_t> by_waste(const Balls& balls) const;
    std::vector<Sphere> spheres_of(const Balls& balls) const;

private:
    /// Returns the measure for a ball that was looked at.
    double waste(const Exposed& exposed, const Ball& ball) const;
    /// Moves balls that contain no point alone to where a ball has most excess volume.
    void put_idle_to_use(Balls& balls, const Points& points) const;

    const Problem& problem_;
    std::size_t first_points_;
    std::vector<Points> directions_;
};

/// Random swap as in clustering (Fränti: Efficiency of random swap clustering, Journal of Big Data 5, 2018): a ball at
/// random is removed, one of those with most excess volume is split, and all are refined; the result is kept if it is
/// better. Descents only move balls to their neighbourhood; a swap moves one anywhere. Few swaps are better, so a short
/// descent decides which are worth a long one.
class RandomSwaps {
public:
    /// `coarse`: for splits. All must outlive this.
    RandomSwaps(const Problem& problem, const Improvement& improvement, const FineSurface& skin,
                const IndexedSurface& coarse)
        : problem_(problem), improvement_(improvement), skin_(skin), coarse_(coarse) {}

    /// Returns the best balls after `tries` swaps, which cover the skin. If there are fewer balls than `count`, swaps
    /// add balls and remove none until one is kept. Several swaps are tried at once if there are many. It ends early
    /// once stop() returns true. Deterministic, on any number of threads.
    CoverCandidate improved(const Balls& balls, std::size_t count, int tries, std::uint64_t seed,
                            const std::function<bool()>& stop) const;

private:
    /// Returns the balls after a swap; with infinite volume if it is not worth a long descent.
    CoverCandidate swapped(const CoverCandidate& now, std::size_t count, Random random) const;
    /// Splits a ball. Returns false if none can be split.
    bool split_one(Balls& balls, Random& random) const;
    CoverCandidate settled(const Balls& balls, int steps) const;

    const Problem& problem_;
    const Improvement& improvement_;
    const FineSurface& skin_;
    const IndexedSurface& coarse_;
};

/// Merges the two balls that add least excess volume, again and again, as Ward (1963) merges clusters. The many balls
/// have found where a surface divides: a few made of them are often better than a few from a start of their own.
/// O(n²) for n balls, and a lattice of some hundred cells for each pair that meets.
class Merging {
public:
    /// Begins with balls fitted to the parts of the skin that belong to the given ones. Both must outlive this.
    Merging(const FineSurface& skin, const Occupancy& occupancy, const Balls& balls);

    /// Returns the balls, which contain the skin.
    Balls balls() const;
    /// Replaces two balls by the smallest one that contains the parts of both. Returns false if no two balls meet.
    bool merge_two();

private:
    struct Pair {
        std::size_t first, second;
        Ball merged;
        double price;          ///< volume that the merged ball adds, units³
        bool outdated = false; ///< a ball near it has changed since
        bool has(std::size_t ball) const { return first == ball || second == ball; }
    };
    /// Adds the pairs of a ball with those in the range from `begin` that it meets.
    void add_pairs(std::size_t ball, std::size_t begin);
    Pair priced(std::size_t first, std::size_t second);

    const Occupancy& occupancy_;
    EnclosingBall enclosing_ball_;
    Balls balls_; ///< those merged into others have no radius
    std::vector<Points> parts_;
    std::vector<Pair> pairs_;
    Balls near_; ///< the other balls about the pair that is priced
};

/// Returns sets of balls that contain the skin, at index n one of n balls: what is left of the given balls when pairs
/// have been merged, down to `fewest`. Sets of other numbers are empty.
std::vector<Balls> merged_sets(const FineSurface& skin, const Occupancy& occupancy, const Balls& balls,
                               std::size_t fewest);

/// Returns the volume of a ball less that of the union of two, both outside other balls and outside a solid, units³. It
/// is a sum over a lattice of some hundred cells, to compare pairs by; OutsideVolume is finer, and for many evaluations
/// at one place.
double added_volume(const Ball& merged, const Ball& a, const Ball& b, const Balls& others, const Occupancy& occupancy);

} // namespace foam::inline search::by_spheres
