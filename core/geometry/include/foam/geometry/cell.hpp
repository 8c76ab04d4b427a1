// A solid cut into boxes, and balls that contain the part in each box: the basis of grids, octrees and k-d trees whose
// spheres cover the solid by construction.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// An oriented box with the part of a solid that lies in it. The solid must outlive its cells.
class Cell {
public:
    /// The part of the solid that the balls contain.
    enum class Content {
        solid,   ///< surface and interior
        surface, ///< surface only; cells without surface are left out
    };

    /// Returns the whole solid in its tight box along three orthonormal axes (right-handed). O(triangles).
    static Cell whole(const Solid& solid, const std::array<Vec3, 3>& axes, Content content);
    Cell(const Cell&);
    Cell(Cell&&) noexcept;
    Cell& operator=(const Cell&);
    Cell& operator=(Cell&&) noexcept;
    ~Cell();

    const std::array<Vec3, 3>& axes() const { return axes_; }
    /// The box along the axes, relative to the centre of the solid's bounds.
    const Box& box() const { return box_; }
    /// Returns whether a piece of surface lies in the cell. If not, the cell lies inside the solid.
    bool at_surface() const { return !ends_.empty(); }

    /// Returns the non-empty cells of the box, divided evenly into counts[0] × counts[1] × counts[2], the first axis
    /// fastest. Surface in the face between two cells belongs to the one on the solid's side. Counts are at least 1.
    std::vector<Cell> divided(const std::array<int, 3>& counts) const;
    /// Returns the same content in another box. Precondition: `box` contains the content.
    Cell in_box(const Box& box) const;
    /// Returns about the same content with fewer pieces, for searches: pieces smaller than `size` become points, one
    /// for each cube of that edge length. The box stays the same.
    Cell coarse(double size) const;
    /// Returns the same content along other axes, in its tight box there.
    Cell turned(const std::array<Vec3, 3>& axes) const;
    /// Number of pieces of surface.
    std::size_t pieces() const { return ends_.size(); }
    /// Returns the tight box around the content.
    Box extent() const;

    /// Returns a ball that contains the content, in the solid's frame. It is the smallest ball around the corners of
    /// the surface's pieces, clipped to the box, and around those corners of the box that lie inside the solid: these
    /// points span the convex hull of the content. The ball is larger by a factor of 1e-5, so that proofs need not
    /// subdivide finely where balls meet. The radius is above zero.
    Sphere ball() const;
    /// Returns a large ball inside the solid with its centre in the box, found by a pattern search on the distance to
    /// the surface (Hooke and Jeeves 1961); nothing if no evaluated point is inside.
    std::optional<Sphere> inner_ball() const;

private:
    Cell(const Solid& solid, const std::array<Vec3, 3>& axes, Content content);
    std::pair<Cell, Cell> cut(int axis, double value) const;
    static void divide(Cell&& cell, int axis, int count, std::vector<Cell>& slices);
    Cell empty_copy(const Box& box) const;
    void add_polygon(const Vec3* points, std::size_t count);
    void cut_polygon(const Vec3* points, std::size_t count, int axis, double value, Cell& low, Cell& high) const;
    bool holds_something() const;
    Vec3 to_solid(const Vec3& local) const;
    std::vector<Vec3> inside_corners(const Sphere& known) const;

    const Solid* solid_;
    std::array<Vec3, 3> axes_;
    Vec3 middle_; // of the solid's bounds
    Content content_;
    Box box_;
    std::vector<Vec3> points_;        // convex pieces of the surface, one after the other, along the axes
    std::vector<std::uint32_t> ends_; // one past the last point of each piece
};

/// Returns the axes of the surface's second moments of area, longest extent first, right-handed.
std::array<Vec3, 3> principal_axes(const Solid& solid);

/// Returns the volume, m³, that the union of `spheres` loses when `pieces` replace the sphere at `index`; negative if
/// it grows. It is estimated with 128 quasi-random points per ball, the same every time.
double volume_saved(std::span<const Sphere> spheres, std::size_t index, std::span<const Sphere> pieces);

/// Returns the tree with the fewest spheres, at most `most`, that protrudes by no more than `limit` metres once grown
/// to cover. It doubles the count, then bisects, on the assumption that more spheres protrude less. If no tree does, it
/// returns the one of `most`. `make` returns a tree of at most the given number of spheres.
SphereTree fewest_within(const Solid& solid, double limit, std::size_t most,
                         const std::function<SphereTree(std::size_t)>& make);

} // namespace geometry
} // namespace foam
