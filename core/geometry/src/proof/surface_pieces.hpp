// Patches that together hold the surface of a convex element, each within the hull of a few points.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/internal/triangles.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace foam::inline geometry {

/// A part of an element's surface: the points b + radius · u, where b runs through the hull of the bases of its corners
/// and u through the directions between theirs, times `scale`. A flat part has one direction.
struct SurfacePiece {
    struct Corner {
        Vec3 base, direction; ///< in the element's frame; the direction is unit, or zero
    };
    std::array<Corner, 4> corners;
    std::size_t count = 3; ///< 3, or 4 for b along two opposite sides and u along the other two
    bool flat = false;     ///< one direction, or none
    int level = 0;         ///< halvings so far
};

/// What the pieces of one element have in common.
class ElementSurface {
public:
    /// `origin`: of the frame in which points are given, in that of the link.
    ElementSurface(const Element& element, const Vec3& origin);

    const std::vector<SurfacePiece>& pieces() const { return pieces_; }
    /// Sets `points` to at most 8 points whose hull holds the piece.
    void points(const SurfacePiece& piece, std::vector<Vec3>& points) const;
    /// Sets `normals` to outward normals at the corners: those of all points of the piece are sums of them, with
    /// positive weights. None for a flat piece.
    void normals(const SurfacePiece& piece, std::vector<Vec3>& normals) const;
    /// Returns the outward normal of a flat piece.
    Vec3 normal_of_flat(const SurfacePiece& piece) const;
    /// Returns a triangle of the surface as a piece that was cut.
    SurfacePiece flat_piece(const Corners& triangle) const;
    /// Returns two pieces that make up the piece: cut across its longest side, or across its straight side at a share
    /// of it, unless that is 0.
    std::pair<SurfacePiece, SurfacePiece> halves(const SurfacePiece& piece, double share = 0) const;
    /// Returns the ends of the straight side of a piece of a cylinder; twice the same for other pieces.
    std::array<Vec3, 2> straight_side(const SurfacePiece& piece) const;

private:
    void add_ball(const Vec3& half);
    void add_edges(int axis, const Vec3& half);
    void add_faces(const Vec3& half, double beyond);
    void add_hull(const Polytope& hull);
    Vec3 placed(const SurfacePiece::Corner& corner, double reach) const;
    std::size_t side_to_cut(const SurfacePiece& piece) const;

    Pose pose_; ///< to the frame in which points are given
    Vec3 inside_{};
    double radius_ = 0;
    Vec3 scale_{1, 1, 1};
    std::vector<SurfacePiece> pieces_;
};

} // namespace foam::inline geometry
