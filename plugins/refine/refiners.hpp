// The refiners of this plugin.
#pragma once

#include <foam/sdk/stage.hpp>

namespace foam::refine {

/// Adds spheres one by one, each by splitting one with a plane, while the excess volume falls.
class Split final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override;
};

/// Replaces the spheres of a cylinder or capsule by a row of equal ones along the axis, in closed form, if that has
/// less excess volume.
class Row final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override;
};

/// Guarantee fitted: moves and sizes spheres so that the symmetric difference to the shape becomes small.
class Fit final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override;
};

/// Replaces spheres that violate half-space constraints by such as keep them.
class Clip final : public Refiner {
public:
    std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const override;
};

} // namespace foam::refine
