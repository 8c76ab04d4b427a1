// A set of balls made better: descents with the points that matter, rated by what the balls claim once closed.
#pragma once

#include "cover/descent.hpp"
#include "cover/rated.hpp"

namespace foam::cover {

class Improvement {
public:
    /// `directions`: a ball. The problem must outlive this.
    Improvement(const Problem& problem, std::size_t directions, std::size_t first_points);

    /// `creases`: points between balls are minded all the time, not only in the rating.
    Rated improved(Balls balls, const DescentPlan& plan, bool creases) const;
    /// Indices of the balls, the one that claims most outside first.
    std::vector<std::size_t> by_waste(const Balls& balls) const;
    /// Grown so that they hold the surface; pieces of triangles are followed down to `finest`, units.
    Balls closed_balls(const Balls& balls, double finest) const;
    std::vector<Sphere> spheres_of(const Balls& balls) const;

private:
    double closed_volume(const Balls& balls) const;
    /// Puts balls that hold no point alone where one ball wastes most.
    void put_idle_to_use(Balls& balls, const Points& points) const;

    const Problem& problem_;
    std::size_t first_points_;
    std::vector<Points> directions_, fine_directions_;
};

} // namespace foam::cover
