// Lists of intervals of a line: ascending and disjoint, but for what unite() is given.
#pragma once

#include <foam/solid.hpp>

#include <span>
#include <vector>

namespace foam::geometry {

using Intervals = std::vector<Solid::Interval>;

/// The union of intervals: sorted, disjoint; those that touch become one.
void unite(Intervals& intervals);
/// What is in both.
Intervals common(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b);
/// What of `a` is not in `b`, but for pieces that are no longer than `noise`.
void without(std::span<const Solid::Interval> a, std::span<const Solid::Interval> b, double noise, Intervals& result);
double length(std::span<const Solid::Interval> intervals);

/// The balls that reach between `from` and `to` of a coordinate.
void balls_between(std::span<const Sphere> balls, int axis, double from, double to, std::vector<Sphere>& result);
/// The direction of an axis.
inline Vec3 along(int axis) {
    Vec3 direction{};
    direction[axis] = 1;
    return direction;
}
/// Whether one of the balls holds all of the line through `origin` along an axis between `from` and `to`, relative to
/// `origin`.
bool one_holds(std::span<const Sphere> balls, const Vec3& origin, int axis, double from, double to);
/// Where the line through `origin` along an axis is in the balls, relative to `origin`.
void balls_along(std::span<const Sphere> balls, const Vec3& origin, int axis, Intervals& result);

} // namespace foam::geometry
