// Fewer balls out of many: pairs of balls are merged one after another.
#pragma once

#include "cover/starts/enclosing_ball.hpp"
#include "cover/measured/occupancy.hpp"
#include "cover/starts/power_cells.hpp"

namespace foam::inline search::cover {

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

} // namespace foam::inline search::cover
