// Balls inside a solid that hold as much of it as possible: for guarantee inner.
#pragma once

#include "cover/occupancy.hpp"

#include <functional>
#include <span>

namespace foam::cover {

/// Looks for at most `count` balls in the solid whose union has the greatest volume. Centres are chosen greedily among
/// the cells of a lattice, each ball as large as the solid lets it, always the one that adds most (within 1 - 1/e of
/// the best choice of these: Nemhauser et al. 1978); then each moves to where it adds more (pattern search, Hooke and
/// Jeeves 1961), and the one that adds least is taken away and put elsewhere as long as that helps. Radii are distances
/// to the surface; nothing is proved. Deterministic, on one thread.
class InnerSearch {
public:
    /// `count`: how many balls are wanted; the lattice is the finer the more.
    InnerSearch(const Solid& solid, std::size_t count, std::function<bool()> stop);

    /// From `start` on, fewer balls than wanted. Fewer come out where no cell is left; none if there is no room.
    std::vector<Sphere> balls(std::span<const Sphere> start) const;

private:
    /// Which cells balls hold, and how many hold each.
    using Holders = std::vector<std::uint32_t>;

    Ball ball_about(float x, float y, float z) const;
    /// The slices along z that the ball reaches, as a range of cells.
    std::pair<std::size_t, std::size_t> slices(const Ball& ball) const;
    template <class Body> void for_cells_in(const Ball& ball, Body&& body) const;
    void count_in(const Ball& ball, int change, Holders& holders) const;
    /// How many cells the ball holds that no other does.
    std::size_t gain(const Ball& ball, const Holders& holders) const;
    std::size_t held(const Holders& holders) const;
    void fill(Balls& balls, Holders& holders) const;
    void improve(Balls& balls, Holders& holders) const;
    Ball moved(Ball ball, const Holders& others) const;

    const Solid& solid_;
    std::size_t count_;
    std::function<bool()> stop_;
    Frame frame_;
    Occupancy occupancy_;
    std::vector<std::uint32_t> candidates_; ///< cells, the deepest first
};

} // namespace foam::cover
