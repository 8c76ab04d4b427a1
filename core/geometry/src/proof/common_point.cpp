#include "proof/common_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline geometry {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double parallel = 1e-9; ///< sine
constexpr double rounding = 1e-15;

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
    return dot(a, cross(b, c));
}

} // namespace

Meeting CommonPoint::find(std::span<const std::uint32_t> elements, Vec3& point) {
    constexpr int rounds = 60;
    constexpr double first_share = 1, less = 1e-3, least_share = 1e-9;
    const Vec3 start = point;
    cuts_.clear();
    share_ = first_share;
    for (int round = 0; round < rounds; ++round) {
        if (!add_cuts(elements, point)) {
            return Meeting::common;
        }
        while (!nearest(start, point)) {
            if (conflicting_ > 0 && is_proved_empty(elements)) {
                return Meeting::none;
            }
            if (share_ == 0) {
                return Meeting::doubt;
            }
            share_ = share_ > least_share ? share_ * less : 0;
        }
    }
    return Meeting::doubt;
}

/// Adds a cut for each element that does not hold the point. Returns false if all do.
bool CommonPoint::add_cuts(std::span<const std::uint32_t> elements, const Vec3& point) {
    constexpr double deep = 0.02; // of the element's size
    bool some = false;
    for (const std::uint32_t k : elements) {
        if (bodies_.holds(k, point)) {
            continue;
        }
        some = true;
        Vec3 slope{};
        const double value = walls_.value(k, point, slope), margin = walls_.margin_of(k);
        const Vec3 size = bodies_.bounds(k).size();
        cuts_.push_back(
            {slope, dot(slope, point) - value, margin, 2 * margin + deep * std::min({size.x, size.y, size.z})});
    }
    return some;
}

/// Sets `point` to the one nearest to the start that is within all cuts. Returns false if there is none, and sets
/// conflict_ to cuts that exclude one another.
bool CommonPoint::nearest(const Vec3& start, Vec3& point) {
    point = start;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
        if (beyond(k, point) > 0 && !nearest_in_plane(k, start, point)) {
            return false;
        }
    }
    return true;
}

bool CommonPoint::nearest_in_plane(std::size_t plane, const Vec3& start, Vec3& point) {
    const Vec3& normal = cuts_[plane].normal;
    const double squared = squared_norm(normal);
    conflicting_ = 0;
    if (!(squared > 0)) {
        return false;
    }
    const Vec3 foot = start - normal * (beyond(plane, start) / squared);
    point = foot;
    for (std::size_t k = 0; k < plane; ++k) {
        if (beyond(k, point) > 0 && !nearest_on_line(plane, k, foot, point)) {
            return false;
        }
    }
    return true;
}

bool CommonPoint::nearest_on_line(std::size_t plane, std::size_t second, const Vec3& start, Vec3& point) {
    const Vec3 &m = cuts_[plane].normal, &n = cuts_[second].normal;
    const Vec3 along = cross(m, n);
    const double squared = squared_norm(along);
    if (!(squared > parallel * parallel * squared_norm(m) * squared_norm(n))) {
        conflict_ = {plane, second};
        conflicting_ = dot(m, n) < 0 ? 2 : 0;
        return false;
    }
    // within the plane, across the line
    const Vec3 across = n - m * (dot(m, n) / squared_norm(m));
    const Vec3 foot = start - across * (beyond(second, start) / dot(n, across));
    const Vec3 direction = along / std::sqrt(squared);
    double low = -unbounded, high = unbounded;
    std::size_t low_cut = 0, high_cut = 0;
    for (std::size_t k = 0; k < second; ++k) {
        const double slope = dot(cuts_[k].normal, direction), there = beyond(k, foot);
        if (std::abs(slope) <= parallel * norm(cuts_[k].normal)) {
            if (there > 0) {
                conflict_ = {plane, second, k};
                conflicting_ = 3;
                return false;
            }
        } else if (const double at = -there / slope; slope > 0 && at < high) {
            high = at;
            high_cut = k;
        } else if (slope < 0 && at > low) {
            low = at;
            low_cut = k;
        }
    }
    if (low > high) {
        conflict_ = {plane, second, low_cut, high_cut};
        conflicting_ = 4;
        return false;
    }
    point = foot + direction * std::clamp(0.0, low, high);
    return true;
}

/// Farkas: weights w >= 0 of the cuts with s = Σ w · normal and Σ w · offset < s · x for all x in an element.
bool CommonPoint::is_proved_empty(std::span<const std::uint32_t> elements) const {
    const Box* least = &bodies_.bounds(elements.front());
    for (const std::uint32_t k : elements) {
        if (bodies_.bounds(k).diagonal() < least->diagonal()) {
            least = &bodies_.bounds(k);
        }
    }
    const auto n = [&](std::size_t k) -> const Vec3& { return cuts_[conflict_[k]].normal; };
    std::array<double, 4> weights{};
    if (conflicting_ == 2) {
        weights = {norm(n(1)), norm(n(0))};
    } else if (conflicting_ == 3) {
        weights = {norm(cross(n(1), n(2))), norm(cross(n(0), n(2))), norm(cross(n(0), n(1)))};
    } else {
        weights = {std::abs(determinant(n(1), n(2), n(3))), std::abs(determinant(n(0), n(2), n(3))),
                   std::abs(determinant(n(0), n(1), n(3))), std::abs(determinant(n(0), n(1), n(2)))};
    }
    const Vec3 middle = least->center();
    const double reach = least->diagonal(); // twice what is needed, for the slack
    Vec3 sum{};
    double offsets = 0, all = 0;
    for (std::size_t k = 0; k < conflicting_; ++k) {
        const Cut& cut = cuts_[conflict_[k]];
        sum += n(k) * weights[k];
        offsets += weights[k] * (cut.offset - dot(cut.normal, middle) + cut.margin);
        all += weights[k];
    }
    return offsets + norm(sum) * reach + rounding * all * (reach + norm(middle)) < 0;
}

} // namespace foam::inline geometry
