// Walls of convex elements before a patch of surface, and directions that lead away from them.
#pragma once

#include "proof/bodies.hpp"

#include <span>
#include <vector>

namespace foam::inline geometry {

/// A patch of an element's surface, by points whose hull holds it. Coordinates are relative to the centre of the
/// bodies.
struct PlacedPiece {
    std::uint32_t element = 0;
    std::vector<Vec3> points;
    std::vector<Vec3> normals; ///< of the element at its corners, outwards; none if it is flat
    Vec3 middle{};
    double radius = 0; ///< about the middle
    Box box{};

    /// Sets what follows from the points.
    void measure();
    /// Returns the least of slope · (p - middle) over the patch.
    double least_along(const Vec3& slope) const;
    double width_along(const Vec3& direction) const { return -least_along(direction) - least_along(-direction); }
};

/// A convex function that is at most 0 in an element: how far points are beyond a plane of it, or from it. An element
/// is where all of its walls are at most 0.
struct Wall {
    std::uint32_t element;
    bool flat;
    Vec3 normal; ///< of the plane; else the slope at the middle of the patch
    double low;  ///< a bound from below of the value on the patch
    double turn; ///< about by how much the slope differs on the patch
};

/// The walls of elements before patches. docs/dev/certificate.md has the argument.
class Walls {
public:
    /// Keeps references.
    Walls(std::span<const Element> elements, const Bodies& bodies);

    /// Returns a length above all rounding errors of a wall's value.
    double margin_of(std::uint32_t k) const { return 4 * bodies_.slack(k); }
    /// Returns the value of the element's farthest wall at a point: convex, and at most the distance. Sets `slope` to a
    /// subgradient there.
    double value(std::uint32_t k, const Vec3& p, Vec3& slope) const;
    /// Returns whether the patch is outside an element for certain, by the ball around it. Quick.
    bool is_clear(const PlacedPiece& patch, std::uint32_t k) const;
    /// Appends the walls of an element that a point of the patch may be beyond; one alone that all are beyond. Returns
    /// false if there is such a one: no point of the patch lies in the element.
    bool add(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const;
    /// Returns whether the value of a wall grows, along a way, from all points on that are beyond it and near the
    /// patch.
    bool grows(const PlacedPiece& patch, const Wall& wall, const Vec3& way) const;
    /// Returns how far the patch has to go to be beyond a wall, or infinity. `step`: a length to begin with.
    double length_beyond(const PlacedPiece& patch, const Wall& wall, const Vec3& direction, double step) const;

private:
    void add_plane(const PlacedPiece& patch, std::uint32_t k, const Vec3& normal, double offset,
                   std::vector<Wall>& walls) const;
    void add_plane_pair(const PlacedPiece& patch, std::uint32_t k, int axis, double reach,
                        std::vector<Wall>& walls) const;
    void add_round(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const;
    void add_all(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const;
    bool is_near_edge(const PlacedPiece& patch, std::uint32_t k) const;
    double value_of(std::uint32_t k, const Vec3& p, Vec3& slope) const;
    double value_of(std::uint32_t k, const Vec3& p) const {
        Vec3 slope;
        return value_of(k, p, slope);
    }
    bool grows_round(const PlacedPiece& patch, const Wall& wall, const Vec3& way) const;

    std::span<const Element> elements_;
    const Bodies& bodies_;
    std::vector<std::vector<Polytope::Face>> planes_; ///< of boxes and hulls: normal · p <= offset
};

} // namespace foam::inline geometry
