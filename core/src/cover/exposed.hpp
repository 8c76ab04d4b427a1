// Which directions of a ball's surface lie outside all other balls.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

class Exposed {
public:
    /// False if the ball has no surface outside the others.
    bool look(const Balls& balls, std::size_t i, const Points& directions);
    /// For each direction of the last look: positive outside all other balls. In units of length², it falls to zero
    /// linearly with the distance from the nearest other ball.
    const std::vector<float>& depth() const { return depth_; }

private:
    std::vector<float> depth_;
};

} // namespace foam::cover
