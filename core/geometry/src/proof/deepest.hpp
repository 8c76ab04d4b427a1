// The deepest points of cavities between elements.
#pragma once

#include "solid/solid_data.hpp"

#include <foam/geometry/element.hpp>

#include <span>

namespace foam::inline geometry {

/// A point of a solid, and its distance from all elements; 0 if one holds it.
struct DeepPoint {
    Vec3 point;
    double depth;
};

/// Returns the point that steps lead to from `p`, each deeper than the one before and in the solid. `step`: the first
/// length, `least`: the last one, m.
DeepPoint deepest_from(const SolidData& solid, std::span<const Element> elements, const Vec3& p, double step,
                       double least);

} // namespace foam::inline geometry
