#include "judge.hpp"

#include <algorithm>
#include <numbers>

namespace judge {
namespace {

/// How far beyond the end of a ball is looked, as a share of the triangle.
constexpr Real nudge = 1e-9L;

/// Asks point by point; remembers the worst.
class Search {
public:
    Search(const std::vector<Ball>& balls, Real rounding) : balls_(balls), rounding_(rounding) {}

    void ask(const Point& p) {
        const Real nearest = distance(p);
        if (nearest > 0 && (!worst_ || nearest > worst_->distance)) {
            worst_ = Objection{p, nearest};
        }
    }
    /// How far p is from the nearest ball, beyond doubt; 0 or below: it lies in one.
    Real distance(const Point& p) const {
        Real nearest = std::numeric_limits<Real>::infinity();
        for (const Ball& ball : balls_) {
            // The judge's own: a few roundings to 64 bits of the coordinates.
            const Real own = 0x1p-58L * (length(p) + length(ball.center) + ball.radius);
            nearest = std::min(nearest, length(p - ball.center) - ball.radius - rounding_ - own);
        }
        return nearest;
    }
    const std::vector<Ball>& balls() const { return balls_; }
    const std::optional<Objection>& worst() const { return worst_; }

private:
    const std::vector<Ball>& balls_;
    Real rounding_;
    std::optional<Objection> worst_;
};

void ask_edge(Search& search, const Point& a, const Point& b) {
    const Point d = b - a;
    const Real d2 = dot(d, d);
    if (!(d2 > 0)) {
        return;
    }
    for (const Ball& ball : search.balls()) {
        const Point to_a = a - ball.center;
        const Real half = dot(to_a, d) / d2, root2 = half * half - (dot(to_a, to_a) - ball.radius * ball.radius) / d2;
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
    std::vector<Disc> discs(const std::vector<Ball>& balls) const {
        std::vector<Disc> result;
        for (const Ball& ball : balls) {
            const Point c = ball.center - origin_;
            const Real height = dot(c, normal_), r2 = ball.radius * ball.radius - height * height;
            const Disc disc{dot(c, u_), dot(c, v_), std::sqrt(std::max<Real>(r2, 0))};
            if (r2 > 0 && std::hypot(disc.x, disc.y) < disc.radius + 2 * size_) {
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
    const std::vector<Plane::Disc> discs = plane.discs(search.balls());
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

void ask_triangle(Search& search, const Corners& corners) {
    constexpr int steps = 8; // their half: the middles of the edges
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const Real s = static_cast<Real>(i) / steps, t = static_cast<Real>(j) / steps;
            search.ask(corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]));
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        ask_edge(search, corners[k], corners[(k + 1) % 3]);
    }
    if (const Plane plane(corners); !plane.flat()) {
        ask_within(search, plane);
    }
}

/// A triangle within one ball needs no points: balls are convex.
bool in_one_ball(const Search& search, const Corners& corners) {
    return std::any_of(search.balls().begin(), search.balls().end(), [&](const Ball& ball) {
        return std::all_of(corners.begin(), corners.end(),
                           [&](const Point& p) { return length(p - ball.center) <= ball.radius; });
    });
}

void ask_round(Search& search, const Part& part) {
    constexpr int turns = 96, rows = 24;
    const auto ask = [&](Real angle, Real radius, Real height) {
        search.ask(part.center + radius * std::cos(angle) * part.across + radius * std::sin(angle) * part.up +
                   height * part.axis);
    };
    for (int turn = 0; turn < turns; ++turn) {
        const Real angle = 2 * std::numbers::pi_v<Real> * turn / turns;
        for (int row = 0; row <= rows; ++row) {
            const Real share = static_cast<Real>(row) / rows;
            const Real polar = share * std::numbers::pi_v<Real> / 2;
            for (const Real side : {-1, 1}) {
                if (part.kind == Part::Kind::cylinder) {
                    ask(angle, share * part.radius, side * part.length / 2);
                } else {
                    ask(angle, part.radius * std::sin(polar), side * (part.length / 2 + part.radius * std::cos(polar)));
                }
            }
            ask(angle, part.radius, (share - 0.5L) * part.length);
        }
    }
}

} // namespace

std::optional<Objection> outside_of_balls(const Link& link, const std::vector<Ball>& balls) {
    std::optional<Objection> worst;
    for (const Part& part : link.parts) {
        Search search(balls, part.rounding);
        if (part.kind != Part::Kind::mesh) {
            ask_round(search, part);
        }
        for (const Corners& corners : part.triangles) {
            if (!in_one_ball(search, corners)) {
                ask_triangle(search, corners);
            }
        }
        if (search.worst() && (!worst || search.worst()->distance > worst->distance)) {
            worst = search.worst();
        }
    }
    return worst;
}

} // namespace judge
