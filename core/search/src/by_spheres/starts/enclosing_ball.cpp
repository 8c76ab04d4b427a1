#include "by_spheres/starts/enclosing_ball.hpp"

#include "by_spheres/measured/points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace foam::inline search::by_spheres {

FOAM_FOR_WIDE_VECTORS
Farthest farthest(const Points& points, std::size_t count, const Vec3& from) {
    // Hot loop of the search, vectorised by hand: eight points at a time, with the first farthest point of each lane.
    using Lanes = float __attribute__((vector_size(32)));
    using Places = std::int32_t __attribute__((vector_size(32)));
    constexpr std::size_t lanes = 8;
    const Ball center = ball_of({from, 0});
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    const auto offset = [](const float* values, float by, Lanes& result) {
        std::memcpy(&result, values, sizeof result);
        result -= by;
    };
    const std::size_t whole = count / lanes * lanes;
    Lanes most = Lanes{} - 1;
    Places where{};
    for (std::size_t i = 0; i < whole; i += lanes) {
        Lanes dx, dy, dz;
        offset(x + i, center.x, dx);
        offset(y + i, center.y, dy);
        offset(z + i, center.z, dz);
        const Lanes squared = dx * dx + dy * dy + dz * dz;
        const Places farther = squared > most;
        where = (farther & static_cast<std::int32_t>(i)) | (~farther & where);
        most = squared > most ? squared : most;
    }
    Farthest result{0, -1};
    for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t place = static_cast<std::size_t>(where[l]) + l;
        if (most[l] > result.squared || (most[l] == result.squared && place < result.index)) {
            result = {place, most[l]};
        }
    }
    for (std::size_t i = whole; i < count; ++i) {
        const float squared = center.squared_distance(x[i], y[i], z[i]);
        if (squared > result.squared) {
            result = {i, squared};
        }
    }
    return result;
}

Ball EnclosingBall::of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near) {
    if (count == 0) {
        return {};
    }
    constexpr int rounds = 60;
    constexpr double tolerance = 2e-6;
    basis_[0] = points.at(farthest(points, count, near).index);
    size_ = 1;
    best_ = {basis_[0], 0, 0};
    double reach = 0;
    for (int round = 0; round < rounds; ++round) {
        const Farthest far = farthest(points, count, best_.center);
        reach = std::sqrt(static_cast<double>(far.squared));
        if (reach <= best_.radius * (1 + tolerance)) {
            break;
        }
        const Solution before = best_;
        enter(points.at(far.index), tilt);
        if (!found_) {
            best_ = before;
            break;
        }
    }
    if (reach > best_.radius) {
        best_.radius = std::sqrt(static_cast<double>(farthest(points, count, best_.center).squared));
    }
    return ball_of({best_.center, best_.radius});
}

/// Computes the basis of the last basis' points and a new one, which belongs to it as it lies outside.
void EnclosingBall::enter(const Vec3& point, const Vec3& tilt) {
    pivot_ = point;
    tilt_ = tilt;
    found_ = false;
    best_.cost = std::numeric_limits<double>::infinity();
    descend<0>({}, tilt, 0, 0);
    if (!found_) {
        return;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
        if (best_chosen_ >> i & 1) {
            basis_[kept++] = basis_[i];
        }
    }
    basis_[kept] = point;
    size_ = kept + 1;
}

/// Tries the pivot with the chosen points and with each further one: of the balls through some of them that contain the
/// rest, the cheapest is the solution. `offset`: from the pivot to the centre of their circle in the points' affine
/// hull, which has `axes` dimensions; `tilt`: across it.
template <int axes>
void EnclosingBall::descend(const Vec3& offset, const Vec3& tilt, std::uint32_t chosen, std::size_t first) {
    constexpr double flat = 1e-6;
    const double squared = squared_norm(offset), steepness = squared_norm(tilt);
    // Across the points' affine hull the centre follows the tilt.
    const double across = std::sqrt(squared / (1 - steepness));
    Solution s;
    s.center = pivot_ + offset - tilt * across;
    s.radius = std::sqrt(squared + across * across * steepness);
    s.cost = s.radius + dot(tilt_, s.center - pivot_);
    if (s.cost >= best_.cost) {
        return; // balls through more points cost more
    }
    if (holds_rest(s, chosen)) {
        best_ = s;
        best_chosen_ = chosen;
        found_ = true;
        return;
    }
    if constexpr (axes < 3) {
        for (std::size_t i = first; i < size_; ++i) {
            Vec3 v = basis_[i] - pivot_;
            const double squared_length = squared_norm(v);
            double rest = squared_length / 2;
            for (int k = 0; k < axes; ++k) {
                const double part = dot(v, axis_[k]);
                v -= axis_[k] * part;
                rest -= part * length_[k];
            }
            const double height = norm(v);
            if (!(height > flat * std::sqrt(squared_length))) {
                continue; // it lies in the hull of the others
            }
            const Vec3 axis = v / height;
            axis_[axes] = axis;
            length_[axes] = rest / height;
            const Vec3 next = axes == 2 ? Vec3{} : tilt - axis * dot(tilt, axis);
            descend<axes + 1>(offset + axis * length_[axes], next, chosen | 1u << i, i + 1);
        }
    }
}

bool EnclosingBall::holds_rest(const Solution& s, std::uint32_t chosen) const {
    const double squared = s.radius * s.radius * (1 + 1e-7) + 1e-16;
    for (std::size_t i = 0; i < size_; ++i) {
        if (!(chosen >> i & 1) && squared_norm(basis_[i] - s.center) > squared) {
            return false;
        }
    }
    return true;
}

} // namespace foam::search::by_spheres
