#include "judge.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace judge {
namespace {

struct Bounds {
    Point low{1e300L, 1e300L, 1e300L}, high{-1e300L, -1e300L, -1e300L};

    void add(const Point& p, Real around = 0) {
        low = {std::min(low.x, p.x - around), std::min(low.y, p.y - around), std::min(low.z, p.z - around)};
        high = {std::max(high.x, p.x + around), std::max(high.y, p.y + around), std::max(high.z, p.z + around)};
    }
};

Bounds bounds_of(const Link& link) {
    Bounds bounds;
    for (const Part& part : link.parts) {
        for (const Corners& corners : part.triangles) {
            for (const Point& p : corners) {
                bounds.add(p);
            }
        }
        if (part.kind != Part::Kind::mesh) {
            bounds.add(part.center, body_of(part).reach);
        }
    }
    return bounds;
}

/// A height at which a line upwards crosses the surface; 1: it comes out, -1: it goes in.
struct Crossing {
    Real height;
    int way;
};

std::optional<Crossing> crossing(const Corners& c, Real x, Real y) {
    const auto side = [&](const Point& a, const Point& b) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); };
    const Real u = side(c[1], c[2]), v = side(c[2], c[0]), w = side(c[0], c[1]), all = u + v + w;
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) {
        return std::nullopt;
    }
    return Crossing{(u * c[0].z + v * c[1].z + w * c[2].z) / all, all > 0 ? 1 : -1};
}

/// The solid of a link, along lines upwards in a plane of one x.
class Slice {
public:
    Slice(const Link& link, Real x) : x_(x) {
        for (const Part& part : link.parts) {
            if (part.kind != Part::Kind::mesh) {
                bodies_.push_back(body_of(part));
                continue;
            }
            std::vector<const Corners*>& near = meshes_.emplace_back();
            for (const Corners& c : part.triangles) {
                constexpr Real near_by = 1e-11L;
                if (std::min({c[0].x, c[1].x, c[2].x}) <= x + near_by &&
                    std::max({c[0].x, c[1].x, c[2].x}) >= x - near_by) {
                    near.push_back(&c);
                }
            }
        }
    }
    void move_to(Real y) {
        // Lines go a little beside the point: one through an edge would miss both triangles there.
        constexpr Real aside_x = 1.1e-12L, aside_y = 2.3e-12L; // m
        y_ = y;
        crossings_.clear();
        for (const auto& mesh : meshes_) {
            std::vector<Crossing>& of_mesh = crossings_.emplace_back();
            for (const Corners* corners : mesh) {
                if (const auto at = crossing(*corners, x_ + aside_x, y + aside_y)) {
                    of_mesh.push_back(*at);
                }
            }
        }
    }
    bool holds(Real z) const {
        const auto winds = [&](const std::vector<Crossing>& crossings) {
            int sum = 0;
            for (const Crossing& at : crossings) {
                sum += at.height > z ? at.way : 0;
            }
            return sum != 0;
        };
        return std::any_of(crossings_.begin(), crossings_.end(), winds) ||
               std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
                   return depth(body, {x_, y_, z}, 0) <= 0;
               });
    }

private:
    Real x_, y_ = 0;
    std::vector<std::vector<const Corners*>> meshes_;
    std::vector<std::vector<Crossing>> crossings_; ///< of each mesh
    std::vector<Body> bodies_;
};

/// How far a point is outside all elements; 0 in one.
Real outside_by(const std::vector<Body>& elements, const Point& p) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Body& element : elements) {
        least = std::min(least, depth(element, p, least));
        if (least <= 0) {
            return 0;
        }
    }
    return least;
}

} // namespace

std::optional<Missing> missing_volume(const Link& link, const std::vector<Body>& elements, std::size_t points) {
    const Bounds bounds = bounds_of(link);
    const auto steps = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(points))));
    const Real rounding =
        1e-12L * (bounds.high.x - bounds.low.x + bounds.high.y - bounds.low.y + bounds.high.z - bounds.low.z);
    std::size_t inside = 0, missing = 0;
    Missing result;
    const auto share = [&](std::size_t i, std::size_t shift) {
        // Not the middles of the cells: lines through them would run along edges of many a mesh.
        const Real part = static_cast<Real>(shift + 1) * std::numbers::phi_v<Real>;
        return (static_cast<Real>(i) + part - std::floor(part)) / static_cast<Real>(steps);
    };
    for (std::size_t i = 0; i < steps; ++i) {
        const Real x = bounds.low.x + share(i, i) * (bounds.high.x - bounds.low.x);
        Slice slice(link, x);
        for (std::size_t j = 0; j < steps; ++j) {
            const Real y = bounds.low.y + share(j, i + j) * (bounds.high.y - bounds.low.y);
            slice.move_to(y);
            for (std::size_t k = 0; k < steps; ++k) {
                const Point p{x, y, bounds.low.z + share(k, i * steps + j) * (bounds.high.z - bounds.low.z)};
                if (slice.holds(p.z)) {
                    ++inside;
                    const Real distance = outside_by(elements, p);
                    missing += distance > 0 ? 1 : 0;
                    if (distance > rounding && (!result.farthest || distance > result.farthest->distance)) {
                        result.farthest = Objection{p, distance};
                    }
                }
            }
        }
    }
    if (inside == 0) {
        return std::nullopt;
    }
    result.share = static_cast<Real>(missing) / static_cast<Real>(inside);
    return result;
}

} // namespace judge
