#include "target.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline search::fitted {

using by_spheres::Balls;

/// Returns the cells along the longest extent so that the box has about the same number of cells, whatever its shape.
/// It grows with the number of balls, as one of many balls is small.
static int resolution(const Vec3& size, std::size_t count) {
    const double of_a_cube = 12 * std::cbrt(static_cast<double>(std::max<std::size_t>(count, 16)));
    const double longest = std::max({size.x, size.y, size.z}), volume = size.x * size.y * size.z;
    const double slenderness = volume > 0 ? longest / std::cbrt(volume) : 4;
    return static_cast<int>(std::min(of_a_cube, 64.0) * std::min(slenderness, 4.0));
}

static constexpr std::size_t directions = 128, surface_points = 8000;

/// Returns the factor of the weights of distances. Of a solid that is thin beside its spheres, the missing volume is
/// next to nothing whatever they leave out. Distances then count for it, too.
static double factor_for_thinness(const SymmetricDifference& difference, const Balls& start) {
    constexpr double slope = 0.2, most = 2.1;
    return difference.volume() > 0 ? std::min(1 + slope * difference.of(start) / difference.volume(), most) : most;
}

Target::Target(const Solid& solid, const by_spheres::Frame& frame, std::size_t count, const FitWeights& weights,
               const Balls& start)
    : difference_(solid, frame, resolution(solid.bounds().size(), count), directions,
                  {.excess = weights.excess, .missing = weights.missing}),
      distance_(solid, frame, surface_points) {
    const double area = solid.area() / (frame.unit * frame.unit) * factor_for_thinness(difference_, start);
    of_distance_ = {.mean = weights.distance * area, .high = weights.gap * area};
}

double Target::of(const Balls& balls) const {
    return difference_.of(balls) + distance_.of(balls, of_distance_);
}

void Target::slopes(const Balls& balls, std::size_t turn, std::vector<by_spheres::Slope>& result) const {
    difference_.slopes(balls, turn, result);
    distance_.add_slopes(balls, turn, of_distance_, result);
}

std::vector<double> Target::uses(const Balls& balls) const {
    std::vector<double> result = difference_.uses(balls);
    distance_.add_uses(balls, of_distance_, result);
    return result;
}

} // namespace foam::inline search::fitted
