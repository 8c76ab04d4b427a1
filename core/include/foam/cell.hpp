// A solid cut into boxes, and balls that hold just what is in them: the ground of grids, octrees and k-d trees whose
// spheres cover the solid by construction.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace foam {

/// An oriented box with the part of a solid that lies in it. The solid must outlive its cells.
class Cell {
public:
    /// What the balls are to hold.
    enum class Content {
        solid,   ///< surface and interior
        surface, ///< the surface alone; cells without any are left out
    };

    /// The whole solid in its tight box along three orthonormal axes (right-handed). O(triangles).
    static Cell whole(const Solid& solid, const std::array<Vec3, 3>& axes, Content content);
    Cell(const Cell&);
    Cell(Cell&&) noexcept;
    Cell& operator=(const Cell&);
    Cell& operator=(Cell&&) noexcept;
    ~Cell();

    const std::array<Vec3, 3>& axes() const { return axes_; }
    /// Along the axes, around the middle of the solid's bounds.
    const Box& box() const { return box_; }
    /// Whether a piece of surface lies in it; if not, it is all inside the solid.
    bool at_surface() const { return !ends_.empty(); }

    /// The box divided evenly into counts[0] × counts[1] × counts[2] cells, those that hold something, the first axis
    /// fastest. Surface in the face between two cells belongs to the one on the solid's side. Counts at least 1.
    std::vector<Cell> divided(const std::array<int, 3>& counts) const;
    /// The same content in another box, which must hold it.
    Cell in_box(const Box& box) const;
    /// About the same with fewer pieces, for searches: those smaller than `size` become points, one for each cube of
    /// that edge length. The box stays.
    Cell coarse(double size) const;
    /// The same along other axes, in its tight box there.
    Cell turned(const std::array<Vec3, 3>& axes) const;
    /// The number of pieces of surface.
    std::size_t pieces() const { return ends_.size(); }
    /// The tight box around the content.
    Box extent() const;

    /// A ball that holds the content, in the solid's frame: the smallest around the corners of the surface's pieces,
    /// clipped to the box, and those corners of the box that are inside the solid (these span the convex hull of the
    /// content), and a hundred-thousandth more, so that proofs need not cut finely where balls meet. The radius is
    /// above zero.
    Sphere ball() const;
    /// A large ball inside the solid with its centre in the box, found by a pattern search on the distance to the
    /// surface (Hooke and Jeeves 1961); nothing if no point that was looked at is inside.
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

/// Axes of the surface's second moments of area, longest extent first, right-handed.
std::array<Vec3, 3> principal_axes(const Solid& solid);

/// The volume that the union of `spheres` loses when the one at `index` gives way to `pieces`, m³; negative if it
/// grows. Counted on 128 quasi-random points a ball, the same every time.
double volume_saved(std::span<const Sphere> spheres, std::size_t index, std::span<const Sphere> pieces);

/// The tree with the fewest spheres, at most `most`, that protrudes by no more than `limit` metres once grown to cover:
/// doubling, then bisection, on the assumption that more spheres protrude less. If none does, the one of `most`.
/// `make` gives a tree of at most so many spheres.
SphereTree fewest_within(const Solid& solid, double limit, std::size_t most,
                         const std::function<SphereTree(std::size_t)>& make);

} // namespace foam
