// The rim of an open surface and what the winding number does near it.
#pragma once

#include "geometry/triangle.hpp"

#include <vector>

namespace foam::geometry {

/// The edges that the triangles pass more often one way than the other: the surface's boundary, with multiplicity.
///
/// Off the surface the generalised winding number w is smooth, and its gradient comes from the rim alone, as a magnetic
/// field from a current (Biot and Savart; Jacobson et al. 2013, section 4.2): |∇w(x)| ≤ 1/4π · Σ ∫ dl / |x - l|² over
/// its edges. A ball that meets no triangle therefore has w > 1/2 throughout if that holds at its centre with the
/// integral of this bound along a radius to spare.
class Rim {
public:
    Rim() = default; ///< of a closed surface: empty
    explicit Rim(const std::vector<Corners>& triangles);

    bool empty() const { return edges_.empty(); }
    /// The largest radius up to `free`, that of a ball about `p` which meets no triangle, within which the winding
    /// number is proved to be above one half; 0 if there is none. `winding`: at p, rounded down.
    double radius_above_half(const Vec3& p, double winding, double free) const;

private:
    struct Edge {
        Vec3 from, to;
        double times; ///< how often more the one way than the other
    };
    std::vector<Edge> edges_; ///< long ones in pieces
};

} // namespace foam::geometry
