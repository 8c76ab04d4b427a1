// Covering balls with their volume.
#pragma once

#include "points.hpp"

namespace foam::inline search::cover {

/// Balls with the volume that they have when they cover the surface, units³.
struct Rated {
    double volume = 0;
    Balls balls;
};

inline bool claims_less(const Rated& a, const Rated& b) {
    return a.volume < b.volume;
}

} // namespace foam::search::cover
