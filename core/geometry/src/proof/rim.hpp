// The rim of an open surface and a bound on the winding number near it.
#pragma once

#include <foam/geometry/internal/triangles.hpp>

#include <vector>

namespace foam::inline geometry {

/// The rim: the edges that the triangles pass more often one way than the other, i.e. the surface's boundary with
/// multiplicity.
///
/// Off the surface the generalised winding number w is smooth, and its gradient depends on the rim alone, like a
/// magnetic field on a current (Biot and Savart; Jacobson et al. 2013, section 4.2): |∇w(x)| ≤ 1/4π · Σ ∫ dl / |x - l|²
/// over its edges. A ball that meets no triangle therefore has w > 1/2 throughout if w at its centre exceeds 1/2 by
/// more than the integral of this bound along a radius.
class Rim {
public:
    Rim() = default; ///< of a closed surface: empty
    explicit Rim(const std::vector<Corners>& triangles);

    bool empty() const { return edges_.empty(); }
    /// Returns the largest radius up to `free` within which the winding number is proved to be above one half; 0 if
    /// there is none. `free`: radius of a ball about `p` that meets no triangle. `winding`: at p, rounded down.
    double radius_above_half(const Vec3& p, double winding, double free) const;

private:
    struct Edge {
        Vec3 from, to;
        double times; ///< number of passes one way minus those the other way
    };
    std::vector<Edge> edges_; ///< long ones are cut into pieces
};

} // namespace foam::geometry
