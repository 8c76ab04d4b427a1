// Downhill simplex in space.
#pragma once

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <array>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A corner of the simplex with its value.
struct DownhillCorner {
    Vec3 place;
    double value = 0;
};

/// Minimises `value` of a place by a downhill simplex (Nelder and Mead 1965): reflection 1, expansion 2, contraction
/// and shrinking by half. The first corners are `start` and those at `size` from it along the axes. It ends after about
/// `evaluations`, or where ended(corners, used), given the corners from least to largest value. Returns the best place.
/// `middle` of three places and of two: the ways to compute it differ in the last bit, and results with it.
template <class Value, class Ended, class Middle>
Vec3 downhill_simplex(const Vec3& start, double size, int evaluations, const Value& value, const Ended& ended,
                      const Middle& middle) {
    int used = 0;
    const auto corner = [&](const Vec3& place) {
        ++used;
        return DownhillCorner{place, value(place)};
    };
    const auto less = [](const DownhillCorner& a, const DownhillCorner& b) { return a.value < b.value; };
    std::array<DownhillCorner, 4> v{corner(start), corner(start + Vec3{size, 0, 0}), corner(start + Vec3{0, size, 0}),
                                    corner(start + Vec3{0, 0, size})};
    while (used < evaluations) {
        std::stable_sort(v.begin(), v.end(), less);
        if (ended(v, used)) {
            break;
        }
        const Vec3 foot = middle(v[0].place, v[1].place, v[2].place), away = foot - v[3].place;
        const DownhillCorner reflected = corner(foot + away);
        if (reflected.value < v[0].value) {
            const DownhillCorner expanded = corner(foot + away * 2);
            v[3] = less(expanded, reflected) ? expanded : reflected;
        } else if (reflected.value < v[2].value) {
            v[3] = reflected;
        } else if (const DownhillCorner contracted = corner(foot + away * (less(reflected, v[3]) ? 0.5 : -0.5));
                   contracted.value < std::min(reflected.value, v[3].value)) {
            v[3] = contracted;
        } else {
            for (std::size_t i = 1; i < 4; ++i) {
                v[i] = corner(middle(v[0].place, v[i].place));
            }
        }
    }
    return std::min_element(v.begin(), v.end(), less)->place;
}

} // namespace geometry
} // namespace foam
