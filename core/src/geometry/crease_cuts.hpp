// Pieces of triangles cut where two balls meet.
#pragma once

#include "geometry/cover.hpp"

namespace foam::geometry {

/// Two pieces: the cut runs from a corner to a point of the edge across, of which `share`, above 0 and below 1, lies
/// before the point. `edge`: 0 from a to b, 1 from b to c, 2 from c to a. Rounds like two halvings, and counts as such.
std::pair<Piece, Piece> cut(const Piece& piece, std::size_t edge, double share);

/// Proves single triangles with few pieces. Of two balls the nearer by power |p - c|² - r² changes at the plane of the
/// circle in which they meet: cut there, what several balls hold together falls apart into what each holds alone
/// (restricted power diagram; Edelsbrunner 1995), where halving would go down to the width of the overlap.
class CreaseCuts {
public:
    /// The balls must outlive this. No piece is the outcome of more halvings.
    CreaseCuts(const Balls& balls, std::uint32_t most_halvings) : balls_(balls), most_halvings_(most_halvings) {}

    /// Whether the balls hold the piece. No is no proof of anything: halving may still find that they do.
    /// `candidates`: balls that may. No piece smaller than `smallest` is cut.
    bool cover(const Piece& piece, std::span<const std::uint32_t> candidates, double smallest);
    /// Pieces that the last one was cut into, and the most times that one of them was.
    std::size_t pieces() const { return pieces_; }
    std::uint32_t most_cuts() const { return most_cuts_; }

private:
    struct Waiting {
        Piece piece;
        std::size_t begin, end;  ///< candidates among indices_
        std::uint32_t cuts, off; ///< all so far; those that were not in the middle
    };
    /// Of some corners, as a set of bits, the ball that holds them and comes nearest to holding the piece.
    struct Holder {
        std::uint32_t ball = 0;
        double growth = std::numeric_limits<double>::infinity();
    };
    using Holders = std::array<Holder, 8>;
    struct Crease {
        std::size_t from = 0, to = 0; ///< corners
        double share = 0.5;
        bool found = false;
    };
    enum class Answer { held, open, undecided };

    Answer look(const Waiting& item, Holders& holders) const;
    Crease crease(const Piece& piece, const Holders& holders) const;
    Crease between(const Piece& piece, const Holder& first, const Holder& second, std::size_t from,
                   std::size_t to) const;

    const Balls& balls_;
    std::uint32_t most_halvings_;
    std::size_t pieces_ = 0;
    std::uint32_t most_cuts_ = 0;
    std::vector<Waiting> waiting_;
    std::vector<std::uint32_t> indices_;
};

} // namespace foam::geometry
