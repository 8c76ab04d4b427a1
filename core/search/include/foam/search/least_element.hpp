// The least element of a kind around points, and a proof of how far from the least volume it is.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/search/cover.hpp>

#include <cstddef>
#include <span>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// Returns an element of the kind that contains the points (at least one; metres) and has the least volume that the
/// search finds; for a hull, the convex hull. Flat points get an element with a thickness of a millionth of their size.
/// O(n log n) and, of hull vertices, some hundred passes. `axis_aligned`: for boxes. Throws Error(geometry) without
/// points or for points that are not finite.
Element least_element(Element::Kind kind, std::span<const Vec3> points, Effort effort = Effort::normal,
                      bool axis_aligned = false);

/// An element with a bound on the volume of all elements of its kind around the same points.
struct ProvedElement {
    Element element;
    double volume = 0;      ///< m³
    double lower_bound = 0; ///< m³: no element of the kind that contains the points has less volume
    std::size_t cells = 0;  ///< cells of orientations that were examined
};

/// Returns an element whose volume exceeds that of the least one by at most the share `tolerance`, proved by branch and
/// bound over orientations: an element turned by an angle contains the points once it has grown by that angle times its
/// reach, which bounds the least volume over all orientations of a cell. Kinds: box, cylinder, capsule. Seconds for
/// 1e-3. The proof for capsules takes the least capsule along a direction from a convex problem in the plane that is
/// solved to 1e-7 of the size. Throws Error(usage) for another kind or a tolerance not above 0, Error(geometry) as
/// least_element(), and if a million cells are not enough.
ProvedElement proved_least(Element::Kind kind, std::span<const Vec3> points, double tolerance);

} // namespace search
} // namespace foam
