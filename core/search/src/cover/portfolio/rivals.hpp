// The few of many balls that matter to points close together.
#pragma once

#include "cover/measured/points.hpp"

#include <cstdint>

namespace foam::inline search::cover {

/// Balls with their indices, ascending.
struct Rivals {
    Points centers;
    std::vector<float> radius;
    std::vector<std::int32_t> index;

    std::size_t size() const { return index.size(); }
};

Rivals all_rivals(const Balls& balls);

/// Finds the balls whose power |p - c|² - r² may be least at some of the points in a box. The difference of two powers
/// is linear, so its least value over a box follows from that at the middle.
class RivalSearch {
public:
    /// Writes those of `from` that may have the least power at one of the points from `begin` to `end` to `result`.
    /// None is left out whose power, with the rounding of single precision, is the least or equal to it.
    void find(const Rivals& from, const Points& points, std::size_t begin, std::size_t end, Rivals& result);

private:
    std::vector<float> power_, above_;
};

} // namespace foam::inline search::cover
