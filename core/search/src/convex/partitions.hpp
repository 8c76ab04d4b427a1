// The best partitions of a body, from merges of bricks and from cuts.
#pragma once

#include "cells.hpp"
#include "pieces.hpp"

#include <map>

namespace foam::inline search::convex {

/// How long to search.
struct PartitionPlan {
    std::size_t hull_bricks; ///< bricks for a few hulls; twice as many, and so on, for many
    std::size_t bricks;      ///< for other kinds
    RecutPlan recut;
};

/// Partitions of one body for any number of pieces. What the numbers have in common is computed once.
class Partitions {
public:
    /// `price`: of the element around points alone. `only_hulls`: pieces become hulls, which take finer bricks. Body
    /// and pricing must outlive this.
    Partitions(const Body& body, const Pricing& pricing, Price price, bool only_hulls, const PartitionPlan& plan)
        : body_(body), pricing_(pricing), price_(std::move(price)), only_hulls_(only_hulls), plan_(plan) {}

    /// Returns the better partition that merging and splitting give, recut. Splitting alone does not get to a body with
    /// several legs: the first cut between two of them gains nothing.
    Partition best(std::size_t count);

private:
    /// Bricks, and the merges of them.
    struct Merged {
        std::vector<Brick> bricks;
        Merges merges;
    };
    static constexpr std::size_t bricks_a_piece = 6; ///< at least, where not all are hulls

    /// Returns about so many bricks that make up pieces, and the merges of them. For hulls the same serve for several
    /// numbers.
    const Merged& merged_bricks(std::size_t most);
    /// Returns the bricks that pieces are made of, about `most`. For hulls they are put together where that adds
    /// little.
    const std::vector<Brick>& bricks(std::size_t most);
    /// Returns how many bricks so many pieces are made of. Several counts have the same, and share what is found.
    std::size_t bricks_for(std::size_t count) const;
    /// Returns the partition that merges of bricks give.
    Partition by_merging(std::size_t count, std::size_t number);
    /// Returns the partition that cuts of pieces give. Goes on from that into fewer pieces of the same bricks.
    Partition by_splitting(std::size_t count);
    double price_of(const Partition& partition) const;

    const Body& body_;
    const Pricing& pricing_;
    const Price price_;
    const bool only_hulls_;
    const PartitionPlan plan_;
    std::map<std::size_t, Merged> merged_;             ///< by the number asked for
    std::map<std::size_t, std::vector<Brick>> bricks_; ///< of hulls, the same
    /// By number of bricks: partitions by number of pieces.
    std::map<std::size_t, std::map<std::size_t, Partition>> splits_;
};

} // namespace foam::inline search::convex
