// Lists of intervals of a line: ascending and disjoint, except the input of unite().
#pragma once

#include <foam/geometry/solid.hpp>

#include <span>
#include <vector>

namespace foam::inline geometry {

using Intervals = std::vector<Solid::Interval>;

/// Replaces the intervals with their union: sorted, disjoint; those that touch become one.
void unite(Intervals& intervals);
/// Returns the intersection of both.
Intervals common(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b);
/// Returns in `result` the part of `a` that is not in `b`, without pieces of at most the length `noise`.
void without(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b, double noise, Intervals& result);
double length(std::span<const Solid::Interval> intervals);

/// Returns whether a ball reaches between `from` and `to` of a coordinate.
inline bool reaches_between(const Sphere& s, int axis, double from, double to) {
    return s.center[axis] + s.radius >= from && s.center[axis] - s.radius <= to;
}
/// Returns in `result` the balls that reach between `from` and `to` of a coordinate.
void balls_between(std::span<const Sphere> balls, int axis, double from, double to, std::vector<Sphere>& result);
/// Returns the unit vector of an axis.
inline Vec3 along(int axis) {
    Vec3 direction{};
    direction[axis] = 1;
    return direction;
}
/// Returns whether one of the balls contains the whole line through `origin` along an axis between `from` and `to`,
/// relative to `origin`.
bool one_holds(std::span<const Sphere> balls, const Vec3& origin, int axis, double from, double to);
/// Returns in `result` the part of the line through `origin` along an axis inside the balls, relative to `origin`.
void balls_along(std::span<const Sphere> balls, const Vec3& origin, int axis, Intervals& result);

} // namespace foam::geometry
