// Triangles cut where balls meet.
#pragma once

#include "geometry/cover.hpp"

namespace foam::geometry {

/// Proves single triangles with few pieces. Of two balls the one whose power |p - c|² - r² is less changes at a plane,
/// that of the circle in which they meet. If balls hold a triangle, each holds the part of it where its power is least
/// (restricted power diagram; Edelsbrunner 1995), a convex polygon: cut along such planes, the triangle falls into
/// pieces that one ball holds, where halving would go down to the width of the balls' overlap.
class CreaseCuts {
public:
    /// The balls must outlive this. No piece's corners have been through more roundings than those of so many halvings.
    CreaseCuts(const Balls& balls, std::uint32_t most_halvings) : balls_(balls), most_halvings_(most_halvings) {}

    /// Whether the balls hold a piece that was not halved. No is no proof of anything: halving may still find that they
    /// do. `candidates`: balls that may hold parts of it.
    bool cover(const Piece& piece, std::span<const std::uint32_t> candidates);
    /// Raises reach[i] to the distance from ball i's centre within which lies what the balls leave open of the piece
    /// where i's power is the least. Balls that reach so far hold the piece, but for rounding. O(cuts · candidates).
    void raise(const Piece& piece, std::span<const std::uint32_t> candidates, std::vector<double>& reach);
    /// Pieces that the last one was cut into on the way, and the most times that one of them was cut.
    std::size_t pieces() const { return pieces_; }
    std::uint32_t most_cuts() const { return most_cuts_; }

private:
    /// A convex polygon in a triangle; of a prism with what lies beneath its corners.
    struct Polygon {
        static constexpr std::size_t most_corners = 12;
        std::array<Vec3, most_corners> top, beneath;
        std::size_t corners = 0;
        bool curved = false;
        std::uint32_t cuts = 0;
        std::size_t begin = 0, end = 0; ///< balls that may hold parts of it, among indices_

        /// Takes over a corner, or one on the edge to the next; false: there are too many.
        bool add(const Polygon& from, std::size_t corner);
        bool add(const Polygon& from, std::size_t corner, double share);
    };
    /// Two balls, each of which is the nearest by power to a corner.
    struct Pair {
        std::uint32_t first = 0, second = 0;
    };
    enum class Answer { held, open, divided };

    /// Divides the piece until balls hold its parts. Calls goes_on_after(polygon, pair) for each that no ball holds and
    /// no cut divides; false where that says false.
    template <class Open>
    bool walk(const Piece& piece, std::span<const std::uint32_t> candidates, Open goes_on_after);
    void begin(const Piece& piece, std::span<const std::uint32_t> candidates);
    Polygon take();
    /// Open: `pair.first` is the ball whose power is least at all corners.
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
