// Refinement of covering balls pair by pair that always keeps the surface covered.
#pragma once

#include "problem.hpp"
#include "two_balls.hpp"

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
    /// Splits the one of the named balls whose split gains most. Returns false if none can be split.
    bool split(const std::vector<std::size_t>& candidates);
    /// Exchanges pieces until nothing changes, or for the plan's rounds.
    void settle();

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    bool meet(std::size_t i, std::size_t j) const;
    /// Finds the pieces that balls i and j must contain, and their surroundings.
    void look_at(std::size_t i, std::size_t j, const Ball& region);
    bool exchange(std::size_t i, std::size_t j);
    void find_homes();
    void find_near(std::span<const IndexedSurface::Face> faces);
    bool holds(const Ball& ball, const IndexedSurface::Face& face) const;

    const IndexedSurface& skin_;
    ExchangePlan plan_;
    Balls balls_;
    std::vector<std::uint32_t> home_; ///< for each face a ball that contains it alone, or none
    std::vector<std::uint32_t> near_; ///< balls
    Remainder remainder_;
    OutsideVolume outside_;
    std::vector<char> moved_; ///< for each ball, whether it moved since homes were found
    Content content_;
    std::vector<std::uint32_t> faces_;
    Balls others_;
};

} // namespace foam::search::cover
