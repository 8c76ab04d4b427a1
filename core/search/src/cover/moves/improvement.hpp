// Refinement of a set of balls by descents on the points that matter.
#pragma once

#include "cover/descent/descent.hpp"

namespace foam::inline search::cover {

/// Returns the indices of the values, that of the largest first, of equal ones in order.
std::vector<std::size_t> by_falling(const std::vector<double>& values);

class Improvement {
public:
    /// `directions`: per ball. The problem must outlive this.
    Improvement(const Problem& problem, std::size_t directions, std::size_t first_points);

    /// Returns the refined balls. `creases`: include points between balls. The balls contain the points of the last
    /// update, not yet the whole surface.
    Balls improved(Balls balls, const DescentPlan& plan, bool creases) const;
    /// Returns a measure of the excess volume of a ball outside the others. Only balls that meet it matter.
    double waste(const Balls& balls, std::size_t i) const;
    /// Returns the indices of the balls, the one with most excess volume first.
    std::vector<std::size_t> by_waste(const Balls& balls) const;
    std::vector<Sphere> spheres_of(const Balls& balls) const;

private:
    /// Returns the measure for a ball that was looked at.
    double waste(const Exposed& exposed, const Ball& ball) const;
    /// Moves balls that contain no point alone to where a ball has most excess volume.
    void put_idle_to_use(Balls& balls, const Points& points) const;

    const Problem& problem_;
    std::size_t first_points_;
    std::vector<Points> directions_;
};

} // namespace foam::search::cover
