// Triangles cut along the faces of bodies and between them.
#pragma once

#include "proof/bodies.hpp"

#include <foam/base/cancellation.hpp>

namespace foam::inline geometry {

/// Pieces so many times longer than the gap are cut between bodies.
constexpr double long_piece = 4;

/// Proves single triangles by cutting them into convex polygons that one body contains each. A box or a hull is cut out
/// along its planes: what is left is proved by other bodies. So a triangle that many polytopes share takes one piece
/// for each of them and the sides of its rest, however little they overlap. Two other bodies that hold its edges hold
/// it, cut between them; among more of them it is halved.
class BodyCuts {
public:
    /// Roundings of a corner on a cut, in halvings.
    static constexpr std::uint32_t roundings = 2;

    /// The bodies must outlive this. The roundings of a piece's corners amount to at most `most_halvings` halvings.
    BodyCuts(const Bodies& bodies, std::uint32_t most_halvings) : bodies_(bodies), most_halvings_(most_halvings) {}

    /// Returns whether the bodies cover the triangle; false proves nothing. `candidates`: bodies that may contain parts
    /// of it. Gives up after `most_pieces` pieces, and at pieces below the size `smallest`.
    bool cover(const Corners& triangle, std::span<const std::uint32_t> candidates, double smallest,
               std::size_t most_pieces);
    /// Returns convex polygons: what is left of the triangle where no boxes or hulls are. Round bodies may contain
    /// parts of it. Their corners are within the rounding that a proof allows for.
    std::vector<std::vector<Vec3>> rest(const Corners& triangle, std::span<const std::uint32_t> candidates,
                                        std::size_t most_pieces);
    /// Returns the triangles of a triangle cut between two bodies that are nearest to different corners, where they
    /// need the same growth: a gap between two bodies may be long and narrow. None if one body is nearest to all
    /// corners. `near`: bodies that may be nearest to a point of it.
    std::vector<Corners> between_nearest(const Corners& triangle, std::span<const std::uint32_t> near) const;
    std::size_t pieces() const { return pieces_; }
    std::uint32_t most_cuts() const { return most_cuts_; }
    /// Returns a part of a piece that a cut gave.
    static Piece part_of(const Piece& piece, const Corners& corners) {
        return {.corners = corners, .beneath = {}, .triangle = piece.triangle, .level = piece.level + roundings};
    }

private:
    struct Polygon {
        static constexpr std::size_t most_corners = 16;
        std::array<Vec3, most_corners> corner;
        std::size_t corners = 0;
        std::uint32_t cuts = 0;
        std::size_t begin = 0, end = 0; ///< range in indices_ of the bodies that may contain parts of it

        bool add(const Vec3& p) {
            if (corners == most_corners) {
                return false;
            }
            corner[corners++] = p;
            return true;
        }
        /// A bit for each corner.
        std::uint32_t all() const { return (1u << corners) - 1; }
    };
    struct Parts {
        Polygon low, high; ///< where the value is at most 0, and the rest
    };

    std::vector<Corners> between(const Corners& triangle, std::uint32_t first, std::uint32_t second) const;
    void begin(const Corners& triangle, std::span<const std::uint32_t> candidates, std::size_t most_pieces);
    bool take(Polygon& next);
    /// Returns whether a body contains the polygon.
    bool held(const Polygon& polygon, std::uint32_t body) const;
    bool prove(const Polygon& polygon);
    bool held_by_two(const Polygon& polygon);
    bool cut_out(const Polygon& polygon, std::uint32_t polytope);
    bool divide(const Polygon& polygon);
    void push(Polygon polygon, const Polygon& whole, std::uint32_t without);
    /// Cuts along the line where value(p) is 0. Returns false if it has too many corners or cuts, or if the line does
    /// not cross the polygon once.
    template <class Value> bool split(const Polygon& polygon, Value value, Parts& parts) const;

    const Bodies& bodies_;
    std::uint32_t most_halvings_;
    double smallest_ = 0;
    std::size_t pieces_ = 0, most_pieces_ = 0;
    std::uint32_t most_cuts_ = 0;
    std::vector<Polygon> waiting_;
    /// A body with the corners of the present polygon that it holds, a bit each.
    struct Holder {
        std::uint32_t body, corners;
    };
    std::vector<Holder> holders_;
    std::vector<std::uint32_t> indices_;
    CancellationCounter asking_{256};
};

} // namespace foam::geometry
