#include "cover/enclosing_ball.hpp"

#include "cover/wide_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace foam::cover {

FOAM_FOR_WIDE_VECTORS
Farthest farthest(const Points& points, std::size_t count, const Vec3& from) {
    // The hot loop of the search: eight at a time in so many words, chunk by chunk; then the place in the best chunk.
    using Lanes = float __attribute__((vector_size(32)));
    constexpr std::size_t lanes = 8, chunk = 4 * lanes;
    const Ball center = ball_of({from, 0});
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    const auto offset = [](const float* values, float by, Lanes& result) {
        std::memcpy(&result, values, sizeof result);
        result -= by;
    };
    const std::size_t whole = count / chunk * chunk;
    std::size_t best_chunk = whole;
    float most = -1;
    for (std::size_t begin = 0; begin < whole; begin += chunk) {
        Lanes squared = Lanes{} - 1;
        for (std::size_t i = begin; i < begin + chunk; i += lanes) {
            Lanes dx, dy, dz;
            offset(x + i, center.x, dx);
            offset(y + i, center.y, dy);
            offset(z + i, center.z, dz);
            const Lanes s = dx * dx + dy * dy + dz * dz;
            squared = s > squared ? s : squared;
        }
        float most_here = squared[0];
        for (std::size_t l = 1; l < lanes; ++l) {
            most_here = std::max(most_here, squared[l]);
        }
        if (most_here > most) {
            most = most_here;
            best_chunk = begin;
        }
    }
    Farthest result{0, -1};
    const auto look = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float squared = center.squared_distance(x[i], y[i], z[i]);
            if (squared > result.squared) {
                result = {i, squared};
            }
        }
    };
    look(best_chunk, std::min(best_chunk + chunk, whole));
    look(whole, count);
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

/// The basis of the points of the last one and a new one, which is part of it as it lies outside.
void EnclosingBall::enter(const Vec3& point, const Vec3& tilt) {
    pivot_ = point;
    tilt_ = tilt;
    found_ = false;
    best_.cost = std::numeric_limits<double>::infinity();
    Hull alone;
    alone.tilt = tilt;
    descend(alone, 0, 0);
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

/// Tries the pivot with the chosen points and with each further one: of the balls through some of them that hold the
/// rest the cheapest is the one.
void EnclosingBall::descend(const Hull& hull, std::uint32_t chosen, std::size_t first) {
    constexpr double flat = 1e-6;
    const double squared = squared_norm(hull.offset), tilt = squared_norm(hull.tilt);
    // Across the points' affine hull the centre gives way to the tilt.
    const double across = std::sqrt(squared / (1 - tilt));
    Solution s;
    s.center = pivot_ + hull.offset - hull.tilt * across;
    s.radius = std::sqrt(squared + across * across * tilt);
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
    if (hull.axes == 3) {
        return;
    }
    for (std::size_t i = first; i < size_; ++i) {
        Vec3 v = basis_[i] - pivot_;
        const double squared_length = squared_norm(v);
        double rest = squared_length / 2;
        for (int k = 0; k < hull.axes; ++k) {
            const double part = dot(v, hull.axis[k]);
            v -= hull.axis[k] * part;
            rest -= part * hull.length[k];
        }
        const double height = norm(v);
        if (!(height > flat * std::sqrt(squared_length))) {
            continue; // it lies in the hull of the others
        }
        Hull next = hull;
        const Vec3 axis = v / height;
        next.axis[hull.axes] = axis;
        next.length[hull.axes] = rest / height;
        next.offset += axis * (rest / height);
        next.tilt -= axis * dot(hull.tilt, axis);
        ++next.axes;
        if (next.axes == 3) {
            next.tilt = {};
        }
        descend(next, chosen | 1u << i, i + 1);
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

} // namespace foam::cover
