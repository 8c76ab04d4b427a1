#include "circle.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace foam::inline search::convex {
namespace {

double squared(const Vec2& a, const Vec2& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

Circle around(const Vec2& a, const Vec2& b) {
    const Vec2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    return {middle, std::sqrt(squared(a, b)) / 2};
}

std::optional<Circle> around(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double d = 2 * (bx * cy - by * cx);
    const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    if (!(std::abs(d) > 1e-14 * (bb + cc))) {
        return std::nullopt;
    }
    const double ux = (cy * bb - by * cc) / d, uy = (bx * cc - cx * bb) / d;
    return Circle{{a.x + ux, a.y + uy}, std::sqrt(ux * ux + uy * uy)};
}

bool holds(const Circle& circle, const Vec2& p) {
    return squared(circle.center, p) <= circle.radius * circle.radius * (1 + 1e-12);
}

/// A basis: at most three points on the circle.
struct Basis {
    std::array<Vec2, 3> points;
    std::size_t size = 0;
    Circle circle;
};

/// Returns the basis of the smallest circle around the points of a basis and another point, which lies on it.
Basis with(const Basis& before, const Vec2& p) {
    Basis best;
    const auto offer = [&](const Basis& candidate) {
        for (std::size_t i = 0; i < before.size; ++i) {
            if (!holds(candidate.circle, before.points[i])) {
                return;
            }
        }
        if (best.size == 0 || candidate.circle.radius < best.circle.radius) {
            best = candidate;
        }
    };
    for (std::size_t i = 0; i < before.size; ++i) {
        offer({{p, before.points[i], {}}, 2, around(p, before.points[i])});
        for (std::size_t j = i + 1; j < before.size; ++j) {
            if (const auto circle = around(p, before.points[i], before.points[j])) {
                offer({{p, before.points[i], before.points[j]}, 3, *circle});
            }
        }
    }
    return best;
}

} // namespace

Circle smallest_circle(std::span<const Vec2> points) {
    const auto farthest = [&](const Vec2& from) {
        std::size_t best = 0;
        double most = -1;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (const double d = squared(points[i], from); d > most) {
                most = d;
                best = i;
            }
        }
        return points[best];
    };
    const Vec2 a = farthest(points.front()), b = farthest(a);
    Basis basis{{a, b, {}}, 2, around(a, b)};
    for (int round = 0; round < 100; ++round) {
        const Vec2 p = farthest(basis.circle.center);
        if (holds(basis.circle, p)) {
            break;
        }
        const Basis next = with(basis, p);
        if (next.size == 0 || !(next.circle.radius > basis.circle.radius)) {
            break;
        }
        basis = next;
    }
    const Vec2 p = farthest(basis.circle.center);
    basis.circle.radius = std::sqrt(squared(p, basis.circle.center));
    return basis.circle;
}

} // namespace foam::inline search::convex
