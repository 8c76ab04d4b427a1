// Bricks put together to pieces, one convex hull each.
#pragma once

#include "cloud.hpp"
#include "cut_search.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace foam::inline search::convex {

/// A piece of the body: some bricks, to be held by one element.
struct Piece {
    std::vector<std::uint32_t> bricks; ///< indices, ascending
    std::vector<Vec3> hull;            ///< vertices of the hull around them
    double price = 0;
    Fit fit; ///< its element, where that is not its hull
    Box box;
    /// The best cut found that makes two of it, of infinite price if there is none; nothing until it is looked for.
    std::optional<Cut> split;
    double split_gain = 0; ///< what that cut saves
};

/// What some pieces cost beside the others, and what others in their place would.
struct Beside {
    double now = 0;
    PairPrice price;
};

/// The prices of a search.
class Pricing {
public:
    virtual ~Pricing() = default;
    /// Sets the price of a piece alone, and its fit.
    virtual void appraise(Piece& piece) const = 0;
    /// Returns the prices in place of one or two pieces, beside the others. For several threads at once.
    virtual Beside beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const = 0;
};

/// The bricks and the pieces that they form. Every brick is in one piece.
struct Partition {
    std::vector<Brick> bricks;
    std::vector<Piece> pieces;

    double price() const; ///< sum over the pieces
};

/// Returns the piece of these bricks, without a price and a fit.
Piece piece_of(const std::vector<Brick>& bricks, std::vector<std::uint32_t> members);
/// Returns the piece of these bricks, appraised.
Piece piece_of(const std::vector<Brick>& bricks, std::vector<std::uint32_t> members, const Pricing& pricing);

/// The merges of bricks into fewer and fewer pieces: from one piece a brick, the two pieces whose common element adds
/// least to the price become one, again and again (Mamou and Ghorbel 2009, for hulls). Pieces that do not touch come
/// together when none is left that touches another.
class Merges {
public:
    Merges(const std::vector<Brick>& bricks, Price price);

    /// Returns so many pieces (at least 1), or one a brick where those are fewer. They have no fits.
    std::vector<Piece> at(std::size_t count) const;

private:
    std::size_t bricks_;
    std::vector<Piece> pieces_;           ///< one a brick, and then one for each merge
    std::vector<std::size_t> dead_after_; ///< the number of merges after which a piece is part of another
};

/// Returns one brick for each piece.
std::vector<Brick> united(const std::vector<Brick>& bricks, const std::vector<Piece>& pieces);

struct RecutPlan {
    int sweeps = 3;      ///< over all pairs of neighbours
    int tries = 24;      ///< planes for each pair
    int split_tries = 6; ///< planes to improve the cut of one piece
};

/// Makes the price less: two neighbours are cut anew by a plane that is moved and tilted, and two pieces
/// become one where another gains more from being cut in two. The number of pieces stays.
void recut(Partition& partition, const Pricing& pricing, const RecutPlan& plan);
/// Cuts pieces until there are `count`, or none can be cut: the piece that gains most by its cut is the next.
void split_until(Partition& partition, const Pricing& pricing, std::size_t count, const RecutPlan& plan);

} // namespace foam::inline search::convex
