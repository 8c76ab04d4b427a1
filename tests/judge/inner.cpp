#include "judge.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

namespace judge {
namespace {

Real determinant(const Point& a, const Point& b, const Point& c) {
    return dot(a, cross(b, c));
}

/// Solid angle of the triangle over that of a whole sphere, signed (Van Oosterom, Strackee 1983).
Real share_of_view(const Corners& corners, const Point& from) {
    const Point a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
    const Real la = length(a), lb = length(b), lc = length(c);
    const Real below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return std::atan2(determinant(a, b, c), below) / (2 * std::numbers::pi_v<Real>);
}

Real winding(const Part& part, const Point& from) {
    Real sum = 0;
    for (const Corners& corners : part.triangles) {
        sum += share_of_view(corners, from);
    }
    return sum;
}

Point nearest_on_edge(const Point& a, const Point& b, const Point& p) {
    const Point d = b - a;
    const Real d2 = dot(d, d);
    return a + (d2 > 0 ? std::clamp<Real>(dot(p - a, d) / d2, 0, 1) : 0) * d;
}

Point nearest_on(const Corners& corners, const Point& p) {
    const Point e = corners[1] - corners[0], f = corners[2] - corners[0], n = cross(e, f), q = p - corners[0];
    const Real n2 = dot(n, n);
    if (n2 > 0) {
        const Real s = dot(cross(q, f), n) / n2, t = dot(cross(e, q), n) / n2;
        if (s >= 0 && t >= 0 && s + t <= 1) {
            return corners[0] + s * e + t * f;
        }
    }
    Point best = corners[0];
    for (std::size_t k = 0; k < 3; ++k) {
        const Point at = nearest_on_edge(corners[k], corners[(k + 1) % 3], p);
        best = length(p - at) < length(p - best) ? at : best;
    }
    return best;
}

Point nearest_on(const Part& part, const Point& p) {
    Point best = part.triangles.front()[0];
    for (const Corners& corners : part.triangles) {
        const Point at = nearest_on(corners, p);
        best = length(p - at) < length(p - best) ? at : best;
    }
    return best;
}

/// By how much p lies outside; 0 or below: it lies inside, or no farther out than rounding explains.
Real depth_outside(const Part& part, const Point& p) {
    if (part.kind == Part::Kind::mesh) {
        constexpr Real half = 0.5L - 1e-9L;
        return std::abs(winding(part, p)) >= half ? 0 : length(p - nearest_on(part, p)) - part.rounding;
    }
    const Point q = p - part.center;
    const Real height = std::abs(dot(q, part.axis)), from_axis = std::hypot(dot(q, part.across), dot(q, part.up));
    const Real beyond = std::max<Real>(height - part.length / 2, 0);
    const Real outside = part.kind == Part::Kind::cylinder ? std::max(height - part.length / 2, from_axis - part.radius)
                                                           : std::hypot(beyond, from_axis) - part.radius;
    return outside - part.rounding;
}

Real depth_outside(const Link& link, const Point& p) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Part& part : link.parts) {
        least = std::min(least, depth_outside(part, p));
        if (least <= 0) {
            break;
        }
    }
    return least;
}

std::vector<Point> directions(const Link& link, const Ball& ball) {
    std::vector<Point> result;
    constexpr int spread = 24; // a spiral of equal areas
    for (int k = 0; k < spread; ++k) {
        const Real z = 1 - (2 * k + 1) / static_cast<Real>(spread), angle = 2.399963229728653L * k,
                   across = std::sqrt(1 - z * z);
        result.push_back({across * std::cos(angle), across * std::sin(angle), z});
    }
    for (const Part& part : link.parts) {
        if (part.kind == Part::Kind::mesh) {
            const Point to = nearest_on(part, ball.center) - ball.center;
            if (length(to) > 0) {
                result.push_back(1 / length(to) * to);
            }
        }
    }
    return result;
}

bool less(const Point& a, const Point& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}
struct Less {
    bool operator()(const Point& a, const Point& b) const { return less(a, b); }
};

} // namespace

std::optional<Objection> outside_of_solid(const Link& link, const std::vector<Ball>& balls) {
    std::optional<Objection> worst;
    const auto ask = [&](const Point& p) {
        const Real outside = depth_outside(link, p);
        if (outside > 0x1p-58L * length(p) && (!worst || outside > worst->distance)) {
            worst = Objection{p, outside};
        }
    };
    for (const Ball& ball : balls) {
        ask(ball.center);
        for (const Point& direction : directions(link, ball)) {
            ask(ball.center + ball.radius * direction);
        }
    }
    return worst;
}

bool plain(const std::vector<Corners>& triangles) {
    std::map<Point, std::size_t, Less> vertices;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges; // run so, by which triangle
    std::vector<std::size_t> piece(triangles.size());
    const auto root = [&](std::size_t i) {
        while (piece[i] != i) {
            i = piece[i];
        }
        return i;
    };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        piece[t] = t;
        std::array<std::size_t, 3> index{};
        for (std::size_t k = 0; k < 3; ++k) {
            index[k] = vertices.emplace(triangles[t][k], vertices.size()).first->second;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (index[k] == index[(k + 1) % 3] || !edges.emplace(std::pair{index[k], index[(k + 1) % 3]}, t).second) {
                return false;
            }
        }
    }
    for (const auto& [edge, t] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (back == edges.end()) {
            return false;
        }
        piece[root(t)] = root(back->second);
    }
    std::map<std::size_t, Real> volumes;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Point& o = triangles[root(t)][0];
        const Corners& c = triangles[t];
        volumes[root(t)] += determinant(c[0] - o, c[1] - o, c[2] - o);
    }
    return std::all_of(volumes.begin(), volumes.end(),
                       [&](const auto& v) { return v.second != 0 && (v.second > 0) == (volumes.begin()->second > 0); });
}

bool plain(const Link& link) {
    return std::all_of(link.parts.begin(), link.parts.end(),
                       [](const Part& part) { return part.kind != Part::Kind::mesh || plain(part.triangles); });
}

} // namespace judge
