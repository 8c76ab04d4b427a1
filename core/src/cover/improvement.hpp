// A set of balls made better by descents with the points that matter.
#pragma once

#include "cover/descent.hpp"

namespace foam::cover {

class Improvement {
public:
    /// `directions`: a ball. The problem must outlive this.
    Improvement(const Problem& problem, std::size_t directions, std::size_t first_points);

    /// `creases`: points between balls are minded, too. The balls hold the points that were minded last, not yet the
    /// surface.
    Balls improved(Balls balls, const DescentPlan& plan, bool creases) const;
    /// Indices of the balls, the one that claims most outside first.
    std::vector<std::size_t> by_waste(const Balls& balls) const;
    std::vector<Sphere> spheres_of(const Balls& balls) const;

private:
    /// Puts balls that hold no point alone where one ball wastes most.
    void put_idle_to_use(Balls& balls, const Points& points) const;

    const Problem& problem_;
    std::size_t first_points_;
    std::vector<Points> directions_;
};

} // namespace foam::cover
