#include "cover/closing.hpp"

#include "geometry/triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace foam::cover {
namespace {

using geometry::Corners;

/// Largest distance from a point to the triangle.
double reach(const Vec3& center, const Corners& t) {
    return std::sqrt(std::max({squared_norm(t.a - center), squared_norm(t.b - center), squared_norm(t.c - center)}));
}

/// Walks the pieces of a triangle that no ball holds down to small ones, with the balls that may matter to each.
class Walk {
public:
    Walk(std::vector<Sphere>& spheres, double finest) : spheres_(spheres), finest_(finest) {}

    /// leaf(corners, candidates) for every small piece that is not held; it may let balls grow.
    template <class Leaf> void run(const Corners& whole, Leaf leaf) {
        stopped_ = false;
        candidates_.clear();
        for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
            candidates_.push_back(i);
        }
        visit(whole, 0, 0, candidates_.size(), leaf);
    }
    /// For leaf(): no more pieces of this triangle.
    void stop() { stopped_ = true; }

private:
    /// Fewer candidates than this are not sifted: it takes longer than to ask them.
    static constexpr std::size_t few = 4;

    bool holds(const Sphere& s, const Corners& t) const {
        const double squared = s.radius * s.radius;
        return squared_norm(t.a - s.center) <= squared && squared_norm(t.b - s.center) <= squared &&
               squared_norm(t.c - s.center) <= squared;
    }

    template <class Leaf> void visit(const Corners& t, int level, std::size_t begin, std::size_t end, Leaf& leaf) {
        if (stopped_) {
            return;
        }
        for (std::size_t k = begin; k < end; ++k) {
            if (holds(spheres_[candidates_[k]], t)) {
                return;
            }
        }
        const double ab = squared_norm(t.b - t.a), bc = squared_norm(t.c - t.b), ca = squared_norm(t.a - t.c);
        const double longest = std::max({ab, bc, ca});
        const std::size_t first = end - begin > few ? candidates_.size() : begin;
        const std::size_t last = end - begin > few ? sift((t.a + t.b + t.c) / 3, std::sqrt(longest), begin, end) : end;
        if (longest <= finest_ * finest_ || level >= 120) {
            leaf(t, std::span(candidates_).subspan(first, last - first));
        } else if (ab == longest) {
            const Vec3 middle = (t.a + t.b) * 0.5;
            visit({t.a, middle, t.c}, level + 1, first, last, leaf);
            visit({middle, t.b, t.c}, level + 1, first, last, leaf);
        } else if (bc == longest) {
            const Vec3 middle = (t.b + t.c) * 0.5;
            visit({t.a, t.b, middle}, level + 1, first, last, leaf);
            visit({t.a, middle, t.c}, level + 1, first, last, leaf);
        } else {
            const Vec3 middle = (t.c + t.a) * 0.5;
            visit({t.a, t.b, middle}, level + 1, first, last, leaf);
            visit({middle, t.b, t.c}, level + 1, first, last, leaf);
        }
        candidates_.resize(std::min(candidates_.size(), std::max(first, end)));
    }

    /// Appends those that may be nearest to some point within `size` of the middle; returns the new end.
    std::size_t sift(const Vec3& middle, double size, std::size_t begin, std::size_t end) {
        double least = std::numeric_limits<double>::infinity();
        gaps_.clear();
        for (std::size_t k = begin; k < end; ++k) {
            const Sphere& s = spheres_[candidates_[k]];
            gaps_.push_back(distance(s.center, middle) - s.radius);
            least = std::min(least, gaps_.back());
        }
        for (std::size_t k = begin; k < end; ++k) {
            if (gaps_[k - begin] <= least + 2 * size) {
                candidates_.push_back(candidates_[k]);
            }
        }
        return candidates_.size();
    }

    std::vector<Sphere>& spheres_;
    double finest_;
    bool stopped_ = false;
    std::vector<std::uint32_t> candidates_;
    std::vector<double> gaps_;
};

} // namespace

/// Middles of all pieces that no ball holds; nothing if there are too many.
static std::optional<Points> open_points(const Solid& solid, const Frame& frame, std::vector<Sphere>& spheres,
                                         double finest) {
    constexpr std::size_t too_many = 1'000'000;
    Points points;
    Walk walk(spheres, finest);
    const Mesh& surface = solid.surface();
    for (const auto& [a, b, c] : surface.triangles) {
        const Corners whole{frame.to_unit(surface.vertices[a]), frame.to_unit(surface.vertices[b]),
                            frame.to_unit(surface.vertices[c])};
        walk.run(whole, [&](const Corners& t, std::span<const std::uint32_t>) {
            points.add((t.a + t.b + t.c) / 3);
            if (points.size() == too_many) {
                walk.stop();
            }
        });
        if (points.size() >= too_many) {
            return {};
        }
    }
    return points;
}

Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most) {
    std::vector<Sphere> spheres = unit_spheres(balls);
    std::optional<Points> open;
    while (!(open = open_points(solid, frame, spheres, finest))) {
        finest *= 2; // tiny balls leave nearly all of the surface open: no need to see it so finely
    }
    const Points& points = *open;
    if (points.size() <= most) {
        return points;
    }
    Points some;
    for (std::size_t i = 0; i < most; ++i) {
        some.add(points, i * points.size() / most);
    }
    return some;
}

std::vector<Sphere> closed(const Solid& solid, std::vector<Sphere> spheres, double finest) {
    Walk walk(spheres, finest);
    const Mesh& surface = solid.surface();
    for (const auto& [a, b, c] : surface.triangles) {
        walk.run({surface.vertices[a], surface.vertices[b], surface.vertices[c]},
                 [&](const Corners& t, std::span<const std::uint32_t> candidates) {
                     std::uint32_t best = 0;
                     double least = std::numeric_limits<double>::infinity();
                     for (const std::uint32_t i : candidates) {
                         const double growth = reach(spheres[i].center, t) - spheres[i].radius;
                         if (growth < least) {
                             least = growth;
                             best = i;
                         }
                     }
                     spheres[best].radius += std::max(0.0, least) * (1 + 1e-9);
                 });
    }
    return spheres;
}

} // namespace foam::cover
