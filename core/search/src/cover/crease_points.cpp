#include "crease_points.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/surface_runs.hpp>
#include <foam/geometry/internal/triangle.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

namespace foam::inline search::cover {
namespace {

using geometry::Corners;

bool holds(const Sphere& s, const Vec3& p) {
    return squared_norm(p - s.center) <= s.radius * s.radius;
}
bool holds(const Sphere& s, const Corners& t) {
    return holds(s, t.a) && holds(s, t.b) && holds(s, t.c);
}

/// Subdivides the triangles that no single ball contains into small pieces, with the balls that may matter to each.
class Walk {
public:
    Walk(const std::vector<Sphere>& spheres, double finest) : spheres_(spheres), finest_(finest) {}

    /// Calls leaf(corners) for every small piece that no ball contains. Consecutive triangles are often close together:
    /// the candidate balls are selected for several at a time, and the ball that contained the last triangle is tested
    /// first.
    template <class Leaf> void run(const std::vector<Vec3>& vertices, std::span<const Triangle> triangles, Leaf leaf) {
        constexpr std::size_t at_a_time = 32;
        stopped_ = false;
        last_holder_ = 0;
        for (std::size_t begin = 0; begin < triangles.size() && !stopped_; begin += at_a_time) {
            const auto group = triangles.subspan(begin, std::min(at_a_time, triangles.size() - begin));
            find_candidates(vertices, group);
            const std::size_t count = candidates_.size();
            for (std::size_t k = 0; k < group.size(); ++k) {
                const auto& [a, b, c] = group[k];
                triangle_ = static_cast<std::uint32_t>(begin + k);
                const Corners whole{vertices[a], vertices[b], vertices[c]};
                if (spheres_.empty() || !holds(spheres_[last_holder_], whole)) {
                    visit(whole, 0, 0, count, leaf);
                }
            }
        }
    }
    /// Ends the walk from within leaf().
    void stop() { stopped_ = true; }
    /// The place in the list of the triangle that is walked.
    std::uint32_t triangle() const { return triangle_; }

private:
    /// Numbers of candidates up to which selection is slower than testing all of them: in general, and if it is known
    /// which corners they contain.
    static constexpr std::size_t few = 4, few_known = 8;
    static constexpr int deepest = 120;

    void find_candidates(const std::vector<Vec3>& vertices, std::span<const Triangle> group) {
        candidates_.resize(spheres_.size());
        std::iota(candidates_.begin(), candidates_.end(), 0u);
        if (candidates_.size() <= few) {
            return;
        }
        Box box;
        for (const Triangle& triangle : group) {
            for (const std::uint32_t corner : triangle) {
                box.add(vertices[corner]);
            }
        }
        const std::size_t count = candidates_.size();
        sift(box.center(), box.diagonal() / 2, 0, count);
        candidates_.erase(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(count));
    }

    template <class Leaf> void visit(const Corners& t, int level, std::size_t begin, std::size_t end, Leaf& leaf) {
        if (stopped_) {
            return;
        }
        for (std::size_t k = begin; k < end; ++k) {
            if (holds(spheres_[candidates_[k]], t)) {
                last_holder_ = candidates_[k];
                return;
            }
        }
        if (end - begin <= few_known) {
            const auto held_by = [&](const Vec3& p) { return holders(p, begin, end); };
            visit_known(t, {held_by(t.a), held_by(t.b), held_by(t.c)}, level, begin, end, leaf);
            return;
        }
        const double ab = squared_norm(t.b - t.a), bc = squared_norm(t.c - t.b), ca = squared_norm(t.a - t.c);
        const double longest = std::max({ab, bc, ca});
        const std::size_t first = candidates_.size();
        const std::size_t last = sift((t.a + t.b + t.c) / 3, std::sqrt(longest), begin, end);
        if (longest <= finest_ * finest_ || level >= deepest) {
            leaf(t);
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
        candidates_.resize(first);
    }

    /// Returns which of a few candidates contain a point, one bit for each.
    unsigned holders(const Vec3& p, std::size_t begin, std::size_t end) const {
        unsigned result = 0;
        for (std::size_t k = begin; k < end; ++k) {
            result |= static_cast<unsigned>(holds(spheres_[candidates_[k]], p)) << (k - begin);
        }
        return result;
    }

    /// Visits a piece if it is known which candidates contain the corners: only the middle is tested.
    template <class Leaf>
    void visit_known(const Corners& t, const std::array<unsigned, 3>& held, int level, std::size_t begin,
                     std::size_t end, Leaf& leaf) {
        if (stopped_ || (held[0] & held[1] & held[2]) != 0) {
            return;
        }
        const double ab = squared_norm(t.b - t.a), bc = squared_norm(t.c - t.b), ca = squared_norm(t.a - t.c);
        const double longest = std::max({ab, bc, ca});
        if (longest <= finest_ * finest_ || level >= deepest) {
            leaf(t);
            return;
        }
        const Vec3 middle = (ab == longest ? t.a + t.b : bc == longest ? t.b + t.c : t.c + t.a) * 0.5;
        const unsigned there = holders(middle, begin, end);
        if (ab == longest) {
            visit_known({t.a, middle, t.c}, {held[0], there, held[2]}, level + 1, begin, end, leaf);
        } else {
            visit_known({t.a, t.b, middle}, {held[0], held[1], there}, level + 1, begin, end, leaf);
        }
        if (bc == longest && ab != longest) {
            visit_known({t.a, middle, t.c}, {held[0], there, held[2]}, level + 1, begin, end, leaf);
        } else {
            visit_known({middle, t.b, t.c}, {there, held[1], held[2]}, level + 1, begin, end, leaf);
        }
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

    const std::vector<Sphere>& spheres_;
    double finest_;
    bool stopped_ = false;
    std::uint32_t triangle_ = 0, last_holder_ = 0;
    std::vector<std::uint32_t> candidates_;
    std::vector<double> gaps_;
};

/// A piece of a triangle that no ball contains: the triangle's place in a list, and the piece's middle.
struct OpenPiece {
    std::uint32_t triangle;
    Vec3 middle;
};

} // namespace

/// Returns the middles of all pieces that no ball contains, by their places in the list of triangles; nothing if there
/// are too many.
static std::optional<std::vector<OpenPiece>> open_points(const std::vector<Vec3>& vertices,
                                                         std::span<const Triangle> triangles,
                                                         const std::vector<Sphere>& spheres, double finest) {
    constexpr std::size_t too_many = 1'000'000;
    std::vector<OpenPiece> points;
    Walk walk(spheres, finest);
    walk.run(vertices, triangles, [&](const Corners& t) {
        points.push_back({walk.triangle(), (t.a + t.b + t.c) / 3});
        if (points.size() == too_many) {
            walk.stop();
        }
    });
    if (points.size() >= too_many) {
        return {};
    }
    return points;
}

/// Returns those of `balls` that come nearer to a place than their radius and `reach`.
static void select_near(const std::vector<Sphere>& balls, const Vec3& place, double reach, std::vector<Sphere>& near) {
    near.clear();
    std::copy_if(balls.begin(), balls.end(), std::back_inserter(near), [&](const Sphere& s) {
        const double most = s.radius + reach;
        return squared_norm(s.center - place) <= most * most;
    });
}

/// Returns the triangles that no single ball contains, close ones together. Where a ball contains a whole run, its
/// triangles need no look.
static std::vector<std::uint32_t> not_in_one(const Solid& solid, const Frame& frame,
                                             const std::vector<Sphere>& spheres) {
    constexpr std::size_t at_once = 32; // consecutive runs are close together
    constexpr double rounding = 1e-9;   // units
    const geometry::SurfaceRuns& runs = geometry::surface_runs(solid);
    const Mesh& surface = solid.surface();
    std::vector<std::uint32_t> open;
    std::vector<Sphere> near, nearer;
    for (std::size_t begin = 0; begin < runs.size(); begin += at_once) {
        check_cancelled();
        const std::size_t end = std::min(begin + at_once, runs.size());
        Box box;
        double largest = 0;
        for (std::size_t r = begin; r < end; ++r) {
            box.add(runs[r].center / frame.unit);
            largest = std::max(largest, runs[r].radius / frame.unit);
        }
        select_near(spheres, box.center(), box.diagonal() / 2 + largest + rounding, near);
        for (std::size_t r = begin; r < end; ++r) {
            const Vec3 middle = runs[r].center / frame.unit;
            const double radius = runs[r].radius / frame.unit + rounding;
            if (std::any_of(near.begin(), near.end(), [&](const Sphere& s) {
                    const double room = s.radius - radius;
                    return room > 0 && squared_norm(s.center - middle) <= room * room;
                })) {
                continue;
            }
            select_near(near, middle, radius, nearer);
            for (const std::uint32_t i : runs.triangles(r)) {
                const auto& [a, b, c] = surface.triangles[i];
                const Corners corners{frame.to_unit(surface.vertices[a]), frame.to_unit(surface.vertices[b]),
                                      frame.to_unit(surface.vertices[c])};
                if (std::none_of(nearer.begin(), nearer.end(), [&](const Sphere& s) { return holds(s, corners); })) {
                    open.push_back(i);
                }
            }
        }
    }
    return open;
}

Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most) {
    const Mesh& surface = solid.surface();
    const std::vector<Sphere> spheres = unit_spheres(balls);
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    const std::vector<std::uint32_t> open_triangles = not_in_one(solid, frame, spheres);
    for (const std::uint32_t i : open_triangles) {
        const auto corner = static_cast<std::uint32_t>(vertices.size());
        triangles.push_back({corner, corner + 1, corner + 2});
        for (const std::uint32_t vertex : surface.triangles[i]) {
            vertices.push_back(frame.to_unit(surface.vertices[vertex]));
        }
    }
    std::optional<std::vector<OpenPiece>> open;
    while (!(open = open_points(vertices, triangles, spheres, finest))) {
        check_cancelled();
        finest *= 2; // tiny balls leave nearly all of the surface open: a coarse result is enough
    }
    std::stable_sort(open->begin(), open->end(), [&](const OpenPiece& a, const OpenPiece& b) {
        return open_triangles[a.triangle] < open_triangles[b.triangle];
    });
    const std::size_t count = std::min(most, open->size());
    Points some;
    for (std::size_t i = 0; i < count; ++i) {
        some.add((*open)[i * open->size() / count].middle);
    }
    return some;
}

} // namespace foam::search::cover
