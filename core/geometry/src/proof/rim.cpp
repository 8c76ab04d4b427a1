#include "proof/rim.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace foam::inline geometry {
namespace {

/// Share of the surface's extent above which edges are cut: the bound uses the nearest point for the whole piece.
constexpr double longest_piece = 1.0 / 64;

using Key = std::array<double, 3>;
Key key(const Vec3& v) {
    return {v.x, v.y, v.z};
}

double distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 ab = b - a;
    const double length2 = squared_norm(ab);
    const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
    return distance(a + ab * t, p);
}

} // namespace

Rim::Rim(const std::vector<Corners>& triangles) {
    std::map<std::pair<Key, Key>, int> balance;
    Box box;
    for (const Corners& t : triangles) {
        for (const auto& [from, to] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
            box.add(from);
            const Key a = key(from), b = key(to);
            if (a != b) {
                balance[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
    }
    const double longest = longest_piece * box.diagonal();
    for (const auto& [ends, times] : balance) {
        if (times == 0) {
            continue;
        }
        const Vec3 a{ends.first[0], ends.first[1], ends.first[2]};
        const Vec3 step = Vec3{ends.second[0], ends.second[1], ends.second[2]} - a;
        const int pieces = std::max(1, static_cast<int>(std::ceil(norm(step) / longest)));
        for (int k = 0; k < pieces; ++k) {
            edges_.push_back({a + step * (static_cast<double>(k) / pieces),
                              a + step * (static_cast<double>(k + 1) / pieces), std::abs(static_cast<double>(times))});
        }
    }
}

double Rim::radius_above_half(const Vec3& p, double winding, double free) const {
    if (!(winding > 0.5)) {
        return 0;
    }
    struct Source {
        double length, distance;
    };
    std::vector<Source> sources;
    double nearest = free;
    constexpr double safe = 1 - 1e-12;
    check_cancelled();
    for (const Edge& e : edges_) {
        sources.push_back({e.times * distance(e.from, e.to), distance_to_segment(e.from, e.to, p) * safe});
        nearest = std::min(nearest, sources.back().distance);
    }
    // The integral of 1 / (distance - s)² for s from 0 to r.
    const auto fall = [&](double r) {
        double sum = 0;
        for (const Source& s : sources) {
            sum += s.length * r / (s.distance * (s.distance - r));
        }
        return sum / (4 * std::numbers::pi);
    };
    if (nearest == free && fall(free) < winding - 0.5) {
        return free;
    }
    double low = 0, high = nearest;
    for (int step = 0; step < 40; ++step) {
        const double middle = (low + high) / 2;
        (fall(middle) < winding - 0.5 ? low : high) = middle;
    }
    return low;
}

} // namespace foam::geometry
