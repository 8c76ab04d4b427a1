#include "cells.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace foam::inline search::convex {

CutSearch::CutSearch(const std::vector<const Brick*>& bricks, const PairPrice& price, PointsInPlane in_plane)
    : price_(price), in_plane_(std::move(in_plane)) {
    for (const Brick* brick : bricks) {
        box_.add(brick->box);
    }
    set_points(bricks);
}

void CutSearch::set_points(const std::vector<const Brick*>& bricks) {
    std::vector<Vec3> all;
    for (const Brick* brick : bricks) {
        all.insert(all.end(), brick->points.begin(), brick->points.end());
        ends_.push_back(static_cast<std::uint32_t>(all.size()));
    }
    std::vector<std::uint32_t> order(all.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::tie(all[i].x, all[i].y, all[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    corners_.resize(all.size());
    for (const std::uint32_t i : order) {
        if (points_.empty() || points_.back() != all[i]) {
            points_.push_back(all[i]);
        }
        corners_[i] = static_cast<std::uint32_t>(points_.size() - 1);
    }
    std::size_t first = 0;
    for (const Brick* brick : bricks) {
        for (const auto& [a, b] : brick->edges) {
            const auto [low, high] = std::minmax(corners_[first + a], corners_[first + b]);
            edges_.push_back({low, high});
        }
        first += brick->points.size();
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

void CutSearch::divide(const Plane& plane) {
    heights_.clear();
    for (const Vec3& p : points_) {
        heights_.push_back(plane.height(p));
    }
    in_.assign(points_.size(), 0);
    std::size_t first = 0;
    for (const std::uint32_t end : ends_) {
        const std::span corners = std::span(corners_).subspan(first, end - first);
        bool has_below = false, has_above = false;
        for (const std::uint32_t i : corners) {
            has_below = has_below || heights_[i] < -on_plane;
            has_above = has_above || heights_[i] > on_plane;
        }
        const bool cut = has_below && has_above;
        for (const std::uint32_t i : corners) {
            const bool below = cut ? heights_[i] <= on_plane : !has_above;
            const bool above = cut ? heights_[i] >= -on_plane : has_above;
            in_[i] = static_cast<char>(in_[i] | (below ? 1 : 0) | (above ? 2 : 0));
        }
        first = end;
    }
    below_.clear();
    above_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (in_[i] & 1) {
            below_.push_back(points_[i]);
        }
        if (in_[i] & 2) {
            above_.push_back(points_[i]);
        }
    }
    for (const auto& [a, b] : edges_) {
        if (std::min(heights_[a], heights_[b]) < -on_plane && std::max(heights_[a], heights_[b]) > on_plane) {
            const Vec3 c = crossing(points_[a], points_[b], heights_[a], heights_[b]);
            below_.push_back(c);
            above_.push_back(c);
        }
    }
}

Cut CutSearch::at(const Plane& plane, double limit) {
    divide(plane);
    if (below_.empty() || above_.empty()) {
        return {plane};
    }
    if (in_plane_) {
        both_.clear();
        in_plane_(plane, both_);
        below_.insert(below_.end(), both_.begin(), both_.end());
        above_.insert(above_.end(), both_.begin(), both_.end());
    }
    return {plane, price_(below_, above_, limit)};
}

Cut CutSearch::start(std::span<const Plane> planes) {
    constexpr std::size_t directions = 18, most_planes = 16;
    Cut best;
    for (const Vec3& normal : fibonacci_directions(directions)) {
        if (normal.z < 0) {
            continue;
        }
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& p : points_) {
            low = std::min(low, dot(normal, p));
            high = std::max(high, dot(normal, p));
        }
        for (const double share : {0.3, 0.5, 0.7}) {
            if (const Cut cut = at({normal, low + share * (high - low)}, best.price); cut.price < best.price) {
                best = cut;
            }
        }
    }
    std::size_t taken = 0;
    for (std::size_t i = 0; i < planes.size() && taken < most_planes; ++i) {
        const Cut cut = at(planes[i], best.price);
        taken += std::isfinite(cut.price); // a part is not empty
        best = cut.price < best.price ? cut : best;
    }
    return best;
}

Cut CutSearch::improved(Cut best, int tries) {
    constexpr double first_step = 0.08, last_step = 1e-3; // of the size, at the rim of the bricks
    const double reach = box_.diagonal() / 2;
    double step = first_step * box_.diagonal();
    while (tries > 0 && step > last_step * reach) {
        const Vec3 other = std::abs(best.plane.normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 x = normalized(cross(best.plane.normal, other)), y = cross(best.plane.normal, x);
        const Vec3 middle = box_.center() - best.plane.normal * best.plane.height(box_.center());
        Cut next = best;
        for (int k = 0; k < 6; ++k, --tries) {
            const double length = k % 2 == 0 ? step : -step;
            Plane plane = best.plane;
            if (k < 2) {
                plane.offset += length;
            } else {
                plane.normal = normalized(plane.normal + (k < 4 ? x : y) * (length / reach));
                plane.offset = dot(plane.normal, middle);
            }
            if (const Cut found = at(plane, next.price); found.price < next.price) {
                next = found;
            }
        }
        if (next.price < best.price * (1 - 1e-6)) {
            best = next;
        } else {
            step /= 2.5;
        }
    }
    return best;
}

} // namespace foam::inline search::convex
