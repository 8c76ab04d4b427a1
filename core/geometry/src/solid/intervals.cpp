#include "solid/intervals.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline geometry {

void unite(Intervals& intervals) {
    if (intervals.size() < 2) {
        return;
    }
    std::sort(intervals.begin(), intervals.end(), [](const Solid::Interval& a, const Solid::Interval& b) {
        return a.enter != b.enter ? a.enter < b.enter : a.leave < b.leave;
    });
    std::size_t count = 0;
    for (const Solid::Interval& next : intervals) {
        if (count > 0 && next.enter <= intervals[count - 1].leave) {
            intervals[count - 1].leave = std::max(intervals[count - 1].leave, next.leave);
        } else {
            intervals[count++] = next;
        }
    }
    intervals.resize(count);
}

Intervals common(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b) {
    Intervals result;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const Solid::Interval both{std::max(a[i].enter, b[j].enter), std::min(a[i].leave, b[j].leave)};
        if (both.enter < both.leave) {
            result.push_back(both);
        }
        a[i].leave < b[j].leave ? ++i : ++j;
    }
    return result;
}

void without(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b, double noise, Intervals& result) {
    result.clear();
    const auto add = [&](double enter, double leave) {
        if (leave - enter > noise) {
            result.push_back({enter, leave});
        }
    };
    std::size_t j = 0;
    for (const Solid::Interval& piece : a) {
        double enter = piece.enter;
        while (j < b.size() && b[j].leave <= enter) {
            ++j;
        }
        for (std::size_t k = j; k < b.size() && b[k].enter < piece.leave; ++k) {
            add(enter, b[k].enter);
            enter = std::max(enter, b[k].leave);
        }
        add(enter, piece.leave);
    }
}

double length(std::span<const Solid::Interval> intervals) {
    double sum = 0;
    for (const Solid::Interval& interval : intervals) {
        sum += interval.leave - interval.enter;
    }
    return sum;
}

void balls_between(std::span<const Sphere> balls, int axis, double from, double to, std::vector<Sphere>& result) {
    result.clear();
    for (const Sphere& s : balls) {
        if (reaches_between(s, axis, from, to)) {
            result.push_back(s);
        }
    }
}

bool one_holds(std::span<const Sphere> balls, const Vec3& origin, int axis, double from, double to) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return std::any_of(balls.begin(), balls.end(), [&](const Sphere& s) {
        const double du = s.center[u] - origin[u], dv = s.center[v] - origin[v];
        const double middle = s.center[axis] - origin[axis];
        const double farther = std::max(std::abs(from - middle), std::abs(to - middle));
        return du * du + dv * dv + farther * farther <= s.radius * s.radius;
    });
}

void balls_along(std::span<const Sphere> balls, const Vec3& origin, int axis, Intervals& result) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    result.clear();
    for (const Sphere& s : balls) {
        const double du = s.center[u] - origin[u], dv = s.center[v] - origin[v];
        const double half2 = s.radius * s.radius - du * du - dv * dv;
        if (half2 > 0) {
            const double middle = s.center[axis] - origin[axis], half = std::sqrt(half2);
            result.push_back({middle - half, middle + half});
        }
    }
    unite(result);
}

} // namespace foam::geometry
