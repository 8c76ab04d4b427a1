// Triangles cut along the creases between balls.
#pragma once

#include "proof/cover.hpp"

namespace foam::inline geometry {

/// Proves single triangles with few pieces. The ball of lesser power |p - c|² - r² changes between two balls at a
/// plane, that of the circle in which they meet. If balls cover a triangle, each contains the part of it where its
/// power is least (restricted power diagram; Edelsbrunner 1995), a convex polygon. Cuts along such planes divide the
/// triangle into pieces that one ball contains, where halving would have to reach the width of the balls' overlap.
class CreaseCuts {
public:
    /// The balls must outlive this. The roundings of a piece's corners amount to at most `most_halvings` halvings.
    CreaseCuts(const Balls& balls, std::uint32_t most_halvings) : balls_(balls), most_halvings_(most_halvings) {}

    /// Returns whether the balls cover a piece that was not halved. False proves nothing: halving may still find that
    /// they do. `candidates`: balls that may contain parts of it.
    bool cover(const Piece& piece, std::span<const std::uint32_t> candidates);
    /// Raises reach[i] to the distance from ball i's centre that contains the uncovered part of the piece where i's
    /// power is the least. Balls of these radii cover the piece, up to rounding. O(cuts · candidates).
    void raise(const Piece& piece, std::span<const std::uint32_t> candidates, std::vector<double>& reach);
    /// Number of pieces made of the last piece, and the most cuts of one of them.
    std::size_t pieces() const { return pieces_; }
    std::uint32_t most_cuts() const { return most_cuts_; }

private:
    /// A convex polygon in a triangle; for a prism with the points beneath its corners.
    struct Polygon {
        static constexpr std::size_t most_corners = 12;
        std::array<Vec3, most_corners> top, beneath;
        std::size_t corners = 0;
        bool curved = false;
        std::uint32_t cuts = 0;
        std::size_t begin = 0, end = 0; ///< range in indices_ of the balls that may contain parts of it

        /// Copies a corner, or a point on the edge to the next; false if there are too many corners.
        bool add(const Polygon& from, std::size_t corner);
        bool add(const Polygon& from, std::size_t corner, double share);
    };
    /// Two balls, each of which has the least power at a corner.
    struct Pair {
        std::uint32_t first = 0, second = 0;
    };
    enum class Answer { held, open, divided };

    /// Divides the piece until balls contain its parts. Calls goes_on_after(polygon, pair) for each part that no ball
    /// contains and no cut divides; returns false as soon as the call does.
    template <class Open>
    bool walk(const Piece& piece, std::span<const std::uint32_t> candidates, Open goes_on_after);
    void begin(const Piece& piece, std::span<const std::uint32_t> candidates);
    Polygon take();
    /// Classifies the polygon. If it is open, `pair.first` is the ball whose power is least at all corners.
    Answer look(const Polygon& polygon, Pair& pair) const;
    bool cut(const Polygon& polygon, const Pair& pair);
    void push(Polygon& polygon, const Polygon& whole, std::uint32_t owner, std::uint32_t other);

    const Balls& balls_;
    std::uint32_t most_halvings_;
    std::size_t pieces_ = 0;
    std::uint32_t most_cuts_ = 0;
    std::vector<Polygon> waiting_;
    std::vector<std::uint32_t> indices_;
};

} // namespace foam::geometry
