// The pieces that a body is cut into: their prices, and whole partitions.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "cells.hpp"
#include "cloud.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
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
/// become one where another gains more from being cut in two. The number of pieces stays. `faces`: planes to try.
void recut(Partition& partition, const Pricing& pricing, const RecutPlan& plan, std::span<const Plane> faces);
/// Cuts pieces until there are `count`, or none can be cut: the piece that gains most by its cut is the next.
void split_until(Partition& partition, const Pricing& pricing, std::size_t count, const RecutPlan& plan,
                 std::span<const Plane> faces);

/// Sums of the volumes of hulls, which hardly overlap. No other element around a piece has less volume.
class SumOfHulls : public Pricing {
public:
    void appraise(Piece& piece) const override;
    Beside beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const override;
};

/// The volume outside the solid of the union of quick fits. What several elements hold counts once.
class VolumeOutside : public Pricing {
public:
    /// Returns the element of a piece from the points that it is to hold.
    using FitAround = std::function<Fit(std::span<const Vec3>)>;
    /// `has_volume`: of the solid; elements around one without are as thin as they like.
    VolumeOutside(const by_spheres::Occupancy& occupancy, FitAround fit_around, bool has_volume)
        : occupancy_(occupancy), fit_around_(std::move(fit_around)), has_volume_(has_volume) {}

    void appraise(Piece& piece) const override;
    Beside beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const override;

private:
    const by_spheres::Occupancy& occupancy_;
    FitAround fit_around_;
    bool has_volume_;
};

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
        : body_(body), pricing_(pricing), price_(std::move(price)), only_hulls_(only_hulls), plan_(plan),
          planes_(body.faces) {}

    /// Returns the better partition that merging and splitting give, recut. Splitting alone does not get to a body with
    /// several legs: the first cut between two of them gains nothing.
    Partition best(std::size_t count);

private:
    /// Bricks, and the merges of them.
    struct Merged {
        std::vector<Brick> bricks;
        Merges merges;
    };
    /// At least, where not all are hulls. Those of a filled body have bricks inside it besides.
    static constexpr std::size_t bricks_a_piece = 6, bricks_a_filled_piece = 5;

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
    const std::span<const Plane> planes_;              ///< of the body, to try
    std::map<std::size_t, Merged> merged_;             ///< by the number asked for
    std::map<std::size_t, std::vector<Brick>> bricks_; ///< of hulls, the same
    /// By number of bricks: partitions by number of pieces.
    std::map<std::size_t, std::map<std::size_t, Partition>> splits_;
};

} // namespace foam::inline search::convex
