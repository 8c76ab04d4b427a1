// The lengths of a descent's steps.
#pragma once

#include "cover/measured/points.hpp"

#include <cmath>

namespace foam::inline search::cover {

/// Step lengths in units of the balls' mean radius at the start, falling geometrically from first to last.
class StepLengths {
public:
    StepLengths(const Balls& balls, int steps, float first, float last)
        : ratio_(steps > 1 ? std::pow(last / first, 1 / static_cast<float>(steps - 1)) : 1) {
        float size = 0;
        for (const Ball& ball : balls) {
            size += ball.r / static_cast<float>(balls.size());
        }
        length_ = first * size;
    }
    float now() const { return length_; }
    void advance() { length_ *= ratio_; }

private:
    float length_ = 0, ratio_;
};

} // namespace foam::search::cover
