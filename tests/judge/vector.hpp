// Points in extended precision: 64 bits of mantissa, and squares of any double neither overflow nor vanish.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace judge {

using Real = long double;

struct Point {
    Real x = 0, y = 0, z = 0;
};

inline Point operator+(const Point& a, const Point& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point operator*(Real s, const Point& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Real dot(const Point& a, const Point& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(const Point& a) {
    return std::sqrt(dot(a, a));
}
inline bool finite(const Point& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

using Corners = std::array<Point, 3>;

} // namespace judge
