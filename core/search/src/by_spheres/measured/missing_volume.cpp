#include "by_spheres/measured/missing_volume.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {

std::size_t count_missing(const Points& inside, const Balls& balls, Owners& owners) {
    owners.find(inside, balls);
    return static_cast<std::size_t>(
        std::count_if(owners.power.begin(), owners.power.end(), [](float power) { return power > 0; }));
}

double missing_volume(const Occupancy& occupancy, const Balls& balls) {
    Owners owners;
    return static_cast<double>(count_missing(occupancy.inside(), balls, owners)) * std::pow(occupancy.cell(), 3);
}

} // namespace foam::search::by_spheres
