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
template <class Value, class Ended>
Vec3 downhill_simplex(const Vec3& start, double size, int evaluations, const Value& value, const Ended& ended) {
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
        const Vec3 middle = v[0].place / 3 + v[1].place / 3 + v[2].place / 3, away = middle - v[3].place;
        const DownhillCorner reflected = corner(middle + away);
        if (reflected.value < v[0].value) {
            const DownhillCorner expanded = corner(middle + away * 2);
            v[3] = less(expanded, reflected) ? expanded : reflected;
        } else if (reflected.value < v[2].value) {
            v[3] = reflected;
        } else if (const DownhillCorner contracted = corner(middle + away * (less(reflected, v[3]) ? 0.5 : -0.5));
                   contracted.value < std::min(reflected.value, v[3].value)) {
            v[3] = contracted;
        } else {
            for (std::size_t i = 1; i < 4; ++i) {
                v[i] = corner(v[0].place + (v[i].place - v[0].place) * 0.5);
            }
        }
    }
    return std::min_element(v.begin(), v.end(), less)->place;
}

} // namespace geometry
} // namespace foam
