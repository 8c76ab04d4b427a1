// One sphere more, and never more claimed.
#pragma once

#include "cover/exchange.hpp"
#include "cover/improvement.hpp"
#include "geometry/union_parts.hpp"

#include <vector>

namespace foam::cover {

/// Spheres and the joint volume of them and a solid, m³.
struct Claim {
    std::vector<Sphere> spheres;
    double volume;
};

/// Covers of a solid that grow by a sphere at a time, whoever made them.
class Splitting {
public:
    /// The solid must outlive this.
    explicit Splitting(const Solid& solid);

    /// `cover`, of that joint volume, holds the solid's surface, and so does what comes out but for rounding, as single
    /// precision leaves it: grown_to_cover() closes that. One of the spheres becomes two that hold what the others
    /// leave, parted by a plane: the best of those that claim most outside, if that claims less than before, else of
    /// the next ones. If none does (around a ring two spheres claim more than one), the best of all. `cover` itself if
    /// none can be split.
    Claim one_more(const std::vector<Sphere>& cover, double volume);

private:
    std::vector<Sphere> spheres_of(const Balls& balls, const Balls& before, const std::vector<Sphere>& cover) const;

    Problem problem_;
    Improvement improvement_;
    Skin skin_;
    geometry::UnionParts union_{{}}; ///< of the last cover
};

} // namespace foam::cover
