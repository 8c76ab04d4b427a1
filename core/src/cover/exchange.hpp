// Covers made better two balls at a time, without ever leaving anything outside.
#pragma once

#include "cover/problem.hpp"
#include "cover/two_balls.hpp"

namespace foam::cover {

struct ExchangePlan {
    TwoBallSearch::Plan split;
    int evaluations; ///< for two balls that meet
    int rounds;      ///< over those whose neighbours have changed
    int cells;       ///< of the lattice on which volumes are compared
};

/// Balls that hold a skin between them, all of it. Two that meet hand pieces to each other across a plane; what others
/// hold as well, neither of them needs to hold.
class Exchange {
public:
    /// `balls` hold the skin. The problem and the skin must outlive this.
    Exchange(const Problem& problem, const Skin& skin, const ExchangePlan& plan, Balls balls);

    const Balls& balls() const { return balls_; }
    /// Splits that one of the balls in two, of those named, which gains most; false if none can be split.
    bool split(const std::vector<std::size_t>& candidates);
    /// Exchanges until nothing moves, or for the plan's rounds.
    void settle();

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    bool meet(std::size_t i, std::size_t j) const;
    /// Finds what balls i and j must hold, and what is around them.
    void look_at(std::size_t i, std::size_t j, const Ball& region);
    bool exchange(std::size_t i, std::size_t j);
    void find_homes();
    void find_near(std::span<const Skin::Face> faces);
    bool holds(const Ball& ball, const Skin::Face& face) const;

    const Skin& skin_;
    ExchangePlan plan_;
    Balls balls_;
    std::vector<std::uint32_t> home_; ///< of each face a ball that holds it alone, or none
    std::vector<std::uint32_t> near_; ///< balls
    Remainder remainder_;
    OutsideVolume outside_;
    std::vector<char> moved_; ///< of each ball: since homes were found
    Content content_;
    std::vector<std::uint32_t> faces_;
    Balls others_;
};

} // namespace foam::cover
