// Covering balls with their volume.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// Balls with the volume that they have when they cover the surface, units³.
struct CoverCandidate {
    double volume = 0;
    Balls balls;
};

inline bool has_less_volume(const CoverCandidate& a, const CoverCandidate& b) {
    return a.volume < b.volume;
}

} // namespace foam::inline search::cover
