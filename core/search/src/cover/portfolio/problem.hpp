// The data about a solid that searches use.
#pragma once

#include "cover/measured/occupancy.hpp"

#include <memory>

namespace foam::inline search::cover {

struct Problem {
    const Solid* solid;
    Frame frame;
    Occupancy occupancy;
    Points surface; ///< places to cover: vertices and points spread evenly over the area
    double volume;  ///< units³

    /// `resolution`: of the occupancy; `points`: the approximate number of places on the surface.
    Problem(const Solid& solid, int resolution, std::size_t points, std::uint64_t seed);
};

} // namespace foam::search::cover
