// Elements whose union is measured, and the parts of their volume.
#pragma once

#include "solid/intervals.hpp"

#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam::inline geometry {

/// The valid elements of a view, spheres as elements, each with its box.
class ElementSet {
public:
    explicit ElementSet(const Elements& elements);

    std::size_t size() const { return elements_.size(); }
    const Element& operator[](std::size_t i) const { return elements_[i]; }
    const Box& box(std::size_t i) const { return boxes_[i]; }
    /// Returns the box around all elements.
    const Box& bounds() const { return all_; }
    bool hold(const Vec3& p) const;

    using Near = std::vector<std::uint32_t>;
    /// Returns in `near` the elements that reach between `from` and `to` of a coordinate.
    void between(int axis, double from, double to, Near& near) const;
    /// Returns in `result` the part of the line through `origin` along an axis in elements of `near`, relative to
    /// `origin`. Returns the sum of the lengths of the parts in each of them.
    double along(const Near& near, const Vec3& origin, int axis, Intervals& result) const;

    /// Returns the volume of the union: the sum of the elements' volumes, exact, without what lines find to be in
    /// several. The lines go through the cells of a lattice with a corner at `anchor`; they are the same for all
    /// elements, however far these reach. Exact where no two boxes overlap.
    Estimate volume(const Vec3& anchor, const Vec3& cell) const;

private:
    std::vector<Element> elements_;
    std::vector<Box> boxes_;
    Box all_;
};

/// Returns the volume of the union, by lines of a lattice made for a box where elements overlap.
Estimate volume_of_union(const ElementSet& set, const Box& lattice);
/// Returns vol(S \ U), m³, along the solid's lines.
double missing_of(const Solid& solid, const ElementSet& set);
/// Returns the volume of a union of balls, as union_volume() for spheres alone.
double quick_union_volume(std::span<const Sphere> spheres, std::size_t directions);

/// Estimates vol(U \ S) and vol(S \ U). `covered`: the elements contain the whole surface.
Difference volume_difference(const Solid& solid, const ElementSet& set, bool covered, const MeasureOptions& options);
/// Returns the share of the surface's area that lies in the elements.
double covered_share(const Solid& solid, const ElementSet& set, const MeasureOptions& options);
/// Measures the exposed surface of the elements and its distance to the solid, by `samples` points on each.
Protrusion protrusion(const Solid& solid, const ElementSet& set, std::size_t samples);

/// Sets the ratios from the volumes.
void set_ratios(Measures& measures);

} // namespace foam::inline geometry
