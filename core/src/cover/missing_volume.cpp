#include "cover/missing_volume.hpp"

#include "cover/power_cells.hpp"

#include <algorithm>
#include <cmath>

namespace foam::cover {

double missing_volume(const Occupancy& occupancy, const Balls& balls) {
    Owners owners;
    owners.find(occupancy.inside(), balls);
    const auto left = std::count_if(owners.power.begin(), owners.power.end(), [](float power) { return power > 0; });
    return static_cast<double>(left) * std::pow(occupancy.cell(), 3);
}

} // namespace foam::cover
