#include "pieces.hpp"

#include "cells.hpp"

#include <algorithm>
#include <numeric>

namespace foam::inline search::convex {
namespace {

/// Renames the bricks of pieces: each is in one of `united`, whose index is its new name.
void name_bricks(std::vector<Piece>& pieces, const std::vector<Piece>& united, std::size_t bricks) {
    std::vector<std::uint32_t> name(bricks);
    for (std::uint32_t i = 0; i < united.size(); ++i) {
        for (const std::uint32_t brick : united[i].bricks) {
            name[brick] = i;
        }
    }
    for (Piece& piece : pieces) {
        for (std::uint32_t& brick : piece.bricks) {
            brick = name[brick];
        }
        std::sort(piece.bricks.begin(), piece.bricks.end());
        piece.bricks.erase(std::unique(piece.bricks.begin(), piece.bricks.end()), piece.bricks.end());
    }
}

/// Returns the bricks as one piece.
Partition whole(std::vector<Brick> bricks, const Pricing& pricing) {
    Partition partition{.bricks = std::move(bricks), .pieces = {}};
    std::vector<std::uint32_t> all(partition.bricks.size());
    std::iota(all.begin(), all.end(), 0);
    partition.pieces.push_back(piece_of(partition.bricks, std::move(all), pricing));
    return partition;
}

} // namespace

const Partitions::Merged& Partitions::merged_bricks(std::size_t most) {
    std::size_t number = most;
    if (only_hulls_) {
        number = plan_.hull_bricks;
        while (2 * number < most) {
            number *= 2;
        }
    }
    auto found = merged_.find(number);
    if (found == merged_.end()) {
        std::vector<Brick> made = only_hulls_ ? bricks_of(body_, number) : halved_bricks(body_, number);
        Merges merges(made, price_);
        found = merged_.emplace(number, Merged{std::move(made), std::move(merges)}).first;
    }
    return found->second;
}

const std::vector<Brick>& Partitions::bricks(std::size_t most) {
    const Merged& fine = merged_bricks(most);
    if (!only_hulls_ || most >= fine.bricks.size()) {
        return fine.bricks;
    }
    std::vector<Brick>& known = bricks_[most];
    if (known.empty()) {
        known = united(fine.bricks, fine.merges.at(most));
    }
    return known;
}

std::size_t Partitions::bricks_for(std::size_t count) const {
    constexpr std::size_t few_for_hulls = 40;
    if (only_hulls_) {
        return std::max(few_for_hulls, 4 * count);
    }
    std::size_t number = plan_.bricks;
    const std::size_t a_piece = body_.is_filled ? bricks_a_filled_piece : bricks_a_piece;
    while (number < a_piece * count) {
        number *= 2;
    }
    return number;
}

Partition Partitions::by_merging(std::size_t count, std::size_t number) {
    const Merged& fine = merged_bricks(number);
    Partition partition{bricks(number), fine.merges.at(count)};
    if (partition.bricks.size() < fine.bricks.size()) {
        name_bricks(partition.pieces, fine.merges.at(number), fine.bricks.size());
    }
    for (Piece& piece : partition.pieces) {
        pricing_.appraise(piece);
    }
    return partition;
}

Partition Partitions::by_splitting(std::size_t count) {
    // The cuts make bricks finer where that matters: half as many of a filled body serve to begin with.
    const std::size_t usual = bricks_for(count);
    const std::size_t number = !only_hulls_ && body_.is_filled ? std::max(plan_.bricks, usual / 2) : usual;
    std::map<std::size_t, Partition>& known = splits_[number];
    const auto above = known.upper_bound(count);
    Partition partition = above != known.begin() ? std::prev(above)->second : whole(bricks(number), pricing_);
    split_until(partition, pricing_, count, plan_.recut, planes_);
    known.insert_or_assign(count, partition);
    return partition;
}

double Partitions::price_of(const Partition& partition) const {
    std::vector<std::size_t> all(partition.pieces.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return pricing_.beside(partition.pieces, all).now;
}

Partition Partitions::best(std::size_t count) {
    constexpr std::size_t few = 12; // hulls, for which another start is cheap
    const std::size_t number = bricks_for(count);
    Partition best = by_merging(count, number);
    const auto take_better = [&](Partition other) {
        if (price_of(other) < price_of(best)) {
            best = std::move(other);
        }
    };
    if (!only_hulls_ && number > plan_.bricks) {
        take_better(by_merging(count, number / 2));
    }
    if (!only_hulls_ || count <= few) {
        take_better(by_splitting(count));
    }
    recut(best, pricing_, plan_.recut, planes_);
    return best;
}

} // namespace foam::inline search::convex
