// Pieces of a surface that no single ball contains.
#pragma once

#include "cover/measured/points.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline search::cover {

struct PieceCorner {
    float x, y, z;
};

/// A triangle, or a piece of it.
struct SurfacePiece {
    std::uint32_t triangle; ///< index in the surface
    std::array<PieceCorner, 3> corners;
};

/// Divides triangles that no ball contains until each piece is in one ball or its edges are no longer than `finest`.
/// Returns the pieces that are in none, in the order of the triangles; nothing if they are more than `most`. Balls that
/// lie behind others everywhere near a piece are not looked at: a few pieces may be in one of these.
std::optional<std::vector<SurfacePiece>> open_pieces(std::span<const SurfacePiece> triangles, const Balls& balls,
                                                     float finest, std::size_t most);

} // namespace foam::inline search::cover
