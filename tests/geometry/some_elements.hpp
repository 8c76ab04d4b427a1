// Elements of each kind, and how their slack is asked for.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/element.hpp>

#include <cstdint>
#include <vector>

namespace foam::test {

inline constexpr double unit = 0x1p-53;
inline constexpr std::uint32_t most_halvings = 120;
/// Makes the slack large, so that it is seen apart from rounding.
inline constexpr double caution = 1e9;

inline Element some_element(Element::Kind kind, Random& random) {
    const auto length = [&] { return random.uniform(0.5, 1.5); };
    Element e{.kind = kind, .pose = random_pose(random, 2)};
    const bool sharp = kind == Element::Kind::box || kind == Element::Kind::hull || kind == Element::Kind::ellipsoid;
    e.radius = sharp ? 0 : length();
    if (kind == Element::Kind::box || kind == Element::Kind::swept_box || kind == Element::Kind::ellipsoid) {
        e.half = {length(), length(), length()};
    } else if (kind == Element::Kind::capsule || kind == Element::Kind::cylinder) {
        e.half.z = length();
    } else if (kind == Element::Kind::hull) {
        std::vector<Vec3> points;
        for (int k = 0; k < 20; ++k) {
            points.push_back(Vec3{5, 0, 0} + random_direction(random) * length());
        }
        e.hull = convex_hull(points);
    }
    return e;
}

} // namespace foam::test
