#include "polygon.hpp"

#include <algorithm>

namespace judge {
namespace {

/// Newell's normal: twice the area, on the side from which the corners go counter-clockwise.
Point normal_of(const std::vector<Point>& corners) {
    Point normal;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        normal = normal + cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    return normal;
}

bool holds(const Corners& triangle, const Point& p, const Point& normal) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Point &from = triangle[k], &to = triangle[(k + 1) % 3];
        if (dot(cross(to - from, p - from), normal) < 0) {
            return false;
        }
    }
    return true;
}

bool same(const Point& a, const Point& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool is_ear(const std::vector<Point>& corners, std::size_t i, const Point& normal) {
    const std::size_t n = corners.size();
    const Corners ear{corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]};
    if (!(dot(cross(ear[1] - ear[0], ear[2] - ear[0]), normal) > 0)) {
        return false;
    }
    return std::none_of(corners.begin(), corners.end(), [&](const Point& p) {
        return !same(p, ear[0]) && !same(p, ear[1]) && !same(p, ear[2]) && holds(ear, p, normal);
    });
}

} // namespace

void append_polygon(std::vector<Point> corners, std::vector<Corners>& triangles) {
    const Point normal = normal_of(corners);
    for (std::size_t next = 1; corners.size() > 3 && next <= corners.size();) {
        const std::size_t n = corners.size(), i = next % n;
        if (!is_ear(corners, i, normal)) {
            ++next;
            continue;
        }
        triangles.push_back({corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
        next = 1;
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
        triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
}

} // namespace judge
