// What balls leave of a surface and of the space outside.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/measured/surface.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline search::by_spheres {

/// Points whose convex hulls, face by face, contain pieces of a surface; the lines between them are where a plane may
/// cut the hulls.
struct Content {
    Points points;
    std::vector<Line> lines;

    void clear() {
        points.clear();
        lines.clear();
    }
};

/// The part of faces outside balls: for each face the extreme points of the part outside all the balls. A ball is
/// convex, so these are corners, crossings of edges with balls, and places where two balls cross in the face. A ball
/// that contains them contains the whole remainder. Pieces thinner than rounding are left out.
class Remainder {
public:
    /// The skin must outlive this.
    explicit Remainder(const IndexedSurface& skin);

    void find(const std::vector<std::uint32_t>& faces, const Balls& balls, Content& content) {
        find(faces, balls, nullptr, content);
    }
    /// Finds the part within a ball: only balls that meet it matter.
    void find_within(const Ball& within, const std::vector<std::uint32_t>& faces, const Balls& balls,
                     Content& content) {
        find(faces, balls, &within, content);
    }

private:
    void find(const std::vector<std::uint32_t>& faces, const Balls& balls, const Ball* within, Content& content);
    /// Returns false if one of the balls contains the whole face. Otherwise near_ are the balls that may contain a
    /// part.
    bool find_near(const IndexedSurface::Face& face, const Balls& balls);
    /// Returns whether a ball contains the point, or whether it is not wanted.
    bool held(const Vec3& point, std::size_t but = SIZE_MAX, std::size_t and_but = SIZE_MAX) const;
    std::uint32_t corner(std::uint32_t point, Content& content);
    void add_whole(const IndexedSurface::Face& face, Content& content);
    void add_part(const IndexedSurface::Face& face, Content& content);
    void cross_edge(const Vec3& from, const Vec3& to, Content& content);
    void cross_balls(const Vec3& a, const Vec3& b, const Vec3& c, Content& content);
    void add_found(const Vec3& point, Content& content);

    const IndexedSurface& skin_;
    // Marks of the points in the content: the turn in which they were added.
    std::vector<std::uint32_t> place_, corner_turn_, edge_turn_;
    std::uint32_t turn_ = 0;
    const Ball* within_ = nullptr; ///< places outside it are not wanted; null: all are
    Balls near_;
    std::vector<std::uint32_t> found_; ///< of the face's, in the content
};

/// Sums over a lattice of a region. The surfaces of balls are blurred over the width of a cell, so that sums vary
/// smoothly with the balls and are right to second order in the cell.
class OutsideVolume {
public:
    /// `cells`: of the lattice, across the region. The occupancy must outlive this.
    OutsideVolume(const Occupancy& occupancy, int cells) : occupancy_(occupancy), cells_(cells) {}

    /// Prepares the balls around a region, slightly larger than `region`.
    void look(const Balls& others, const Ball& region);
    /// Returns the volume of the union of one or two balls, without the others and the solid, units³. Parts beyond the
    /// region count fully and with a surcharge.
    double of(std::span<const Ball> balls) const;
    /// Returns, for ball `i` of these, the integral of the normal over the exposed surface, divided by its area. It is
    /// at most a half long, as it is valid for small steps only.
    Vec3 tilt(std::span<const Ball> balls, std::size_t i) const;

private:
    void look_along_row(float x, float y, float z, const Balls& others);

    const Occupancy& occupancy_;
    int cells_;
    Ball region_{}; ///< region of the lattice
    float cell_ = 1;
    std::vector<float> row_;
    Points points_; ///< places not entirely inside others or the solid
    std::vector<float> weight_;
};

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

} // namespace foam::inline search::by_spheres
