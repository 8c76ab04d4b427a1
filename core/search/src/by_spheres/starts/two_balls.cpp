#include "by_spheres/starts/two_balls.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/downhill.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline search::by_spheres {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The middle of places of a simplex.
struct MiddlePlace {
    Vec3 operator()(const Vec3& a, const Vec3& b) const { return a + (b - a) * 0.5; }
    Vec3 operator()(const Vec3& a, const Vec3& b, const Vec3& c) const { return a / 3 + b / 3 + c / 3; }
};

bool adds_less_volume(const TwoBalls& a, const TwoBalls& b) {
    return a.volume < b.volume;
}

} // namespace

TwoBallSearch::TwoBallSearch(const Content& content, const OutsideVolume& outside)
    : content_(content), outside_(outside), height_(content.points.size()) {
    // All points may be on one side, and the last slot is written without being counted on either.
    for (Points& half : half_) {
        half.resize(content.points.size() + content.lines.size() + 1);
    }
}

TwoBalls TwoBallSearch::at(const Plane& plane) {
    const Points& p = content_.points;
    const float nx = static_cast<float>(plane.normal.x), ny = static_cast<float>(plane.normal.y),
                nz = static_cast<float>(plane.normal.z), offset = static_cast<float>(plane.offset);
    for (std::size_t i = 0; i < p.size(); ++i) {
        height_[i] = nx * p.x[i] + ny * p.y[i] + nz * p.z[i] - offset;
    }
    // All points are written, and counted on their side only: no branches.
    std::array<std::size_t, 2> counts{};
    const auto put = [&](float x, float y, float z, std::size_t side, bool counts_there) {
        Points& half = half_[side];
        const std::size_t place = counts[side];
        half.x[place] = x;
        half.y[place] = y;
        half.z[place] = z;
        counts[side] += counts_there;
    };
    for (std::size_t i = 0; i < p.size(); ++i) {
        put(p.x[i], p.y[i], p.z[i], 0, height_[i] >= 0);
        put(p.x[i], p.y[i], p.z[i], 1, height_[i] <= 0);
    }
    for (const auto& [a, b] : content_.lines) {
        if (height_[a] * height_[b] < 0) {
            const float t = height_[a] / (height_[a] - height_[b]);
            const float x = p.x[a] + t * (p.x[b] - p.x[a]), y = p.y[a] + t * (p.y[b] - p.y[a]),
                        z = p.z[a] + t * (p.z[b] - p.z[a]);
            put(x, y, z, 0, true);
            put(x, y, z, 1, true);
        }
    }
    TwoBalls two;
    two.plane = plane;
    for (std::size_t side = 0; side < 2; ++side) {
        two.balls[side] = enclosing_ball_.of(half_[side], counts[side], tilts_[side], centers_[side]);
    }
    two.volume = outside_.of(two.balls);
    return two;
}

void TwoBallSearch::set_tilts(const std::array<Ball, 2>& balls) {
    for (std::size_t side = 0; side < 2; ++side) {
        tilts_[side] = balls[side].r > 0 ? outside_.tilt(balls, side) : Vec3{};
        centers_[side] = center_of(balls[side]);
    }
}

TwoBalls TwoBallSearch::descend(const Plane& start, double turn, double shift, int evaluations, int patience,
                                double enough) {
    const Vec3 n = start.normal, u = normalized(cross(n, std::abs(n.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 v = cross(n, u);
    Vec3 middle{};
    for (std::size_t i = 0; i < content_.points.size(); ++i) {
        middle += content_.points.at(i) / static_cast<double>(content_.points.size());
    }
    middle += n * (start.offset - dot(n, middle));
    constexpr double flat = 1e-5;
    TwoBalls best;
    best.volume = infinity;
    const auto value = [&](const Vec3& place) {
        const Vec3 normal = normalized(n + u * (place.x * turn) + v * (place.y * turn));
        const TwoBalls two = at({normal, dot(normal, middle + n * (place.z * shift))});
        if (two.volume < best.volume) {
            best = two;
        }
        return two.volume;
    };
    const auto ended = [&](const auto& corners, int used) {
        const double least = corners.front().value;
        return (used >= patience && least >= enough) || corners.back().value - least < flat * std::abs(least);
    };
    downhill_simplex({}, 1, evaluations, value, ended, MiddlePlace{});
    return best;
}

std::vector<TwoBalls> TwoBallSearch::anywhere(const Plan& plan) {
    tilts_ = {};
    centers_ = {content_.points.at(0), content_.points.at(0)};
    std::vector<TwoBalls> best_along;
    const std::vector<Vec3> directions = geometry::fibonacci_directions(2 * static_cast<std::size_t>(plan.directions));
    for (std::size_t i = 0; i < static_cast<std::size_t>(plan.directions); ++i) {
        double low = infinity, high = -infinity;
        for (std::size_t k = 0; k < content_.points.size(); ++k) {
            const double height = dot(directions[i], content_.points.at(k));
            low = std::min(low, height);
            high = std::max(high, height);
        }
        TwoBalls best;
        best.volume = infinity;
        for (int k = 1; k <= plan.offsets; ++k) {
            check_cancelled();
            const TwoBalls two = at({directions[i], low + (high - low) * k / (plan.offsets + 1)});
            best = two.volume < best.volume ? two : best;
        }
        best_along.push_back(best);
    }
    std::stable_sort(best_along.begin(), best_along.end(), adds_less_volume);
    return best_along;
}

TwoBalls TwoBallSearch::improved(const std::vector<TwoBalls>& starts, const Plan& plan) {
    const double size = std::sqrt(farthest(content_.points, content_.points.size(), content_.points.at(0)).squared);
    TwoBalls best = starts.front();
    for (std::size_t i = 0; i < std::min(starts.size(), static_cast<std::size_t>(plan.kept)); ++i) {
        tilts_ = {};
        const TwoBalls upright = descend(starts[i].plane, 0.2, 0.05 * size, plan.evaluations);
        set_tilts(upright.balls);
        const TwoBalls tilted = descend(upright.plane, 0.1, 0.03 * size, plan.evaluations);
        best = std::min({best, upright, tilted}, adds_less_volume);
    }
    return best;
}

TwoBalls TwoBallSearch::near(const std::array<Ball, 2>& balls, int evaluations) {
    constexpr int patience = 10;
    TwoBalls now;
    now.balls = balls;
    now.volume = outside_.of(balls);
    const Vec3 a = center_of(balls[0]), b = center_of(balls[1]);
    const double apart = distance(a, b), ra = balls[0].r, rb = balls[1].r;
    if (!(apart > 0) || content_.points.size() == 0) {
        return now;
    }
    set_tilts(balls);
    // Starts at the plane of the circle in which they meet.
    const Vec3 n = (a - b) / apart;
    const Plane plane{n, dot(n, a) - (apart * apart + ra * ra - rb * rb) / (2 * apart)};
    const TwoBalls found = descend(plane, 0.15, 0.1 * std::min(ra, rb), evaluations, patience, now.volume);
    return found.volume < now.volume ? found : now;
}

} // namespace foam::search::by_spheres
