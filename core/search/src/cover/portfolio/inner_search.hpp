// Balls inside a solid that contain as much of it as possible: for the guarantee inner.
#pragma once

#include "cover/measured/occupancy.hpp"

#include <functional>
#include <span>

namespace foam::inline search::cover {

/// Searches for at most `count` balls in the solid whose union has the greatest volume. Centres are chosen greedily
/// among the cells of a lattice, each ball as large as the solid allows, always the one that adds most (within 1 - 1/e
/// of the best choice of these: Nemhauser et al. 1978). Then each ball moves to where it adds more (pattern search,
/// Hooke and Jeeves 1961), and the ball that adds least is moved elsewhere as long as that helps. Radii are distances
/// to the surface; nothing is proved. Deterministic, on one thread.
class InnerSearch {
public:
    /// `count`: wanted number of balls; more balls get a finer lattice.
    InnerSearch(const Solid& solid, std::size_t count, std::function<bool()> stop);

    /// Returns the balls, continuing from `start`, which has fewer than wanted. The result has fewer if no cell
    /// remains, none if no ball fits.
    std::vector<Sphere> balls(std::span<const Sphere> start) const;

private:
    /// For each cell, the number of balls that contain it.
    using Holders = std::vector<std::uint32_t>;

    Ball ball_about(float x, float y, float z) const;
    /// Returns the slices along z that the ball reaches, as a range of cells.
    std::pair<std::size_t, std::size_t> slices(const Ball& ball) const;
    template <class Body> void for_cells_in(const Ball& ball, Body&& body) const;
    void count_in(const Ball& ball, int change, Holders& holders) const;
    /// Returns the number of cells that only this ball contains.
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

} // namespace foam::search::cover
