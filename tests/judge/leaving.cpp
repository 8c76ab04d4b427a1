// Just beyond where a triangle leaves elements: a gap between two of them begins there.
#include "search.hpp"

#include <algorithm>
#include <numbers>

namespace judge {
namespace {

/// Where in [0, 1] a function is least that first falls, then rises: by thirds.
template <typename Function> Real least_at(const Function& function) {
    Real low = 0, high = 1;
    for (int round = 0; round < 48; ++round) {
        const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
        (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
    }
    return (low + high) / 2;
}

/// Between a place where the function is at most 0 and one where it is not, the last of the former.
template <typename Function> Real root_between(const Function& function, Real inside, Real outside) {
    for (int round = 0; round < 64; ++round) {
        const Real middle = (inside + outside) / 2;
        (function(middle) > 0 ? outside : inside) = middle;
    }
    return inside;
}

struct LinePart {
    Real enter = 0, leave = 1;
};

/// The part of a + t d from 0 to 1 that all planes of a hull leave.
std::optional<LinePart> part_in_hull(const Body& hull, const Point& a, const Point& d) {
    LinePart part;
    for (const Body::Plane& plane : hull.planes) {
        const Real out = dot(plane.normal, a - hull.place.offset) - plane.offset, slope = dot(plane.normal, d);
        if (slope > 0) {
            part.leave = std::min(part.leave, -out / slope);
        } else if (slope < 0) {
            part.enter = std::max(part.enter, -out / slope);
        } else if (out > 0) {
            return std::nullopt;
        }
    }
    return part.enter < part.leave ? std::optional(part) : std::nullopt;
}

/// Likewise in another element: along a line its depth falls, then rises, since elements are convex.
std::optional<LinePart> part_in(const Body& element, const Point& a, const Point& d) {
    const auto out = [&](Real t) { return depth(element, a + t * d, 0); };
    const Real first = out(0), last = out(1);
    if (std::max(first, last) <= 0) {
        return LinePart{};
    }
    if (std::max(first, last) > length(d) && std::min(first, last) > 0) {
        return std::nullopt;
    }
    const Real within = first <= 0 ? 0 : last <= 0 ? 1 : least_at(out);
    if (!(out(within) <= 0)) {
        return std::nullopt;
    }
    return LinePart{first > 0 ? root_between(out, within, 0) : 0, last > 0 ? root_between(out, within, 1) : 1};
}

void ask_line(Search& search, const Body& element, const Point& a, const Point& b) {
    const auto part = element.kind == Body::Kind::hull ? part_in_hull(element, a, b - a) : part_in(element, a, b - a);
    if (!part) {
        return;
    }
    for (const Real t : {part->enter - nudge, part->leave + nudge}) {
        if (t > 0 && t < 1) {
            search.ask(a + t * (b - a));
        }
    }
}

/// The edges, and across the triangle seven lines along each.
void ask_lines(Search& search, const Corners& corners) {
    constexpr int lines = 8;
    for (const Body* element : search.elements()) {
        for (std::size_t k = 0; k < 3 && element->kind != Body::Kind::ball; ++k) {
            const Point &from = corners[k], &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
            for (int i = 1; i <= lines; ++i) {
                const Real share = static_cast<Real>(i) / lines;
                ask_line(search, *element, from + share * (a - from), from + share * (b - from));
            }
        }
    }
}

void ask_edge(Search& search, const Point& a, const Point& b) {
    const Point d = b - a;
    const Real d2 = dot(d, d);
    if (!(d2 > 0)) {
        return;
    }
    for (const Body* ball : search.elements()) {
        if (ball->kind != Body::Kind::ball) {
            continue;
        }
        const Point to_a = a - ball->place.offset;
        const Real half = dot(to_a, d) / d2, root2 = half * half - (dot(to_a, to_a) - ball->radius * ball->radius) / d2;
        if (!(root2 >= 0)) {
            continue;
        }
        for (const Real t : {-half - std::sqrt(root2) - nudge, -half + std::sqrt(root2) + nudge}) {
            if (t > 0 && t < 1) {
                search.ask(a + t * d);
            }
        }
    }
}

/// The plane of a triangle, and what balls cut out of it.
class Plane {
public:
    explicit Plane(const Corners& corners)
        : origin_(corners[0]), edge_(corners[1] - corners[0]), other_(corners[2] - corners[0]) {
        normal_ = cross(edge_, other_);
        area2_ = length(normal_);
        size_ = std::max(length(edge_), length(other_));
        if (area2_ > 0) {
            normal_ = 1 / area2_ * normal_;
            u_ = 1 / length(edge_) * edge_;
            v_ = cross(normal_, u_);
        }
    }
    bool flat() const { return !(area2_ > 0); }
    Real size() const { return size_; }

    struct Disc {
        Real x, y, radius;
    };
    std::vector<Disc> discs(const std::vector<const Body*>& elements) const {
        std::vector<Disc> result;
        for (const Body* ball : elements) {
            const Point c = ball->place.offset - origin_;
            const Real height = dot(c, normal_), r2 = ball->radius * ball->radius - height * height;
            const Disc disc{dot(c, u_), dot(c, v_), std::sqrt(std::max<Real>(r2, 0))};
            if (ball->kind == Body::Kind::ball && r2 > 0 && std::hypot(disc.x, disc.y) < disc.radius + 2 * size_) {
                result.push_back(disc);
            }
        }
        return result;
    }
    /// Asks for the point of the plane if it lies in the triangle.
    void ask(Search& search, Real x, Real y) const {
        const Point p = x * u_ + y * v_;
        const Real s = dot(cross(p, other_), normal_) / area2_, t = dot(cross(edge_, p), normal_) / area2_;
        if (s >= 0 && t >= 0 && s + t <= 1) {
            search.ask(origin_ + p);
        }
    }

private:
    Point origin_, edge_, other_, normal_, u_, v_;
    Real area2_ = 0, size_ = 0;
};

/// Just beyond both discs, where their rims cross.
void ask_crossings(Search& search, const Plane& plane, const Plane::Disc& a, const Plane::Disc& b) {
    const Real dx = b.x - a.x, dy = b.y - a.y, d = std::hypot(dx, dy);
    const Real along = d > 0 ? (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d) : 0;
    const Real across2 = a.radius * a.radius - along * along;
    if (!(d > 0) || !(across2 > 0)) {
        return;
    }
    for (const Real across : {std::sqrt(across2), -std::sqrt(across2)}) {
        const Real x = a.x + (along * dx - across * dy) / d, y = a.y + (along * dy + across * dx) / d;
        const Real out_x = (x - a.x) / a.radius + (x - b.x) / b.radius,
                   out_y = (y - a.y) / a.radius + (y - b.y) / b.radius, out = std::hypot(out_x, out_y);
        if (out > 0) {
            plane.ask(search, x + nudge * plane.size() * out_x / out, y + nudge * plane.size() * out_y / out);
        }
    }
}

void ask_within(Search& search, const Plane& plane) {
    const std::vector<Plane::Disc> discs = plane.discs(search.elements());
    for (std::size_t i = 0; i < discs.size(); ++i) {
        for (int k = 0; k < 4; ++k) {
            const Real angle = k * std::numbers::pi_v<Real> / 2 + 0.1L, r = discs[i].radius + nudge * plane.size();
            plane.ask(search, discs[i].x + r * std::cos(angle), discs[i].y + r * std::sin(angle));
        }
        for (std::size_t j = 0; j < i; ++j) {
            ask_crossings(search, plane, discs[i], discs[j]);
        }
    }
}

} // namespace

void ask_leaving(Search& search, const Corners& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
        ask_edge(search, corners[k], corners[(k + 1) % 3]);
    }
    ask_lines(search, corners);
    if (const Plane plane(corners); !plane.flat()) {
        ask_within(search, plane);
    }
}

} // namespace judge
