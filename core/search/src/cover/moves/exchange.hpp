// Refinement of covering balls pair by pair that always keeps the surface covered.
#pragma once

#include "cover/portfolio/problem.hpp"
#include "cover/starts/two_balls.hpp"

#include <optional>

namespace foam::inline search::cover {

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

} // namespace foam::inline search::cover
