#include "least_fit.hpp"

#include "cells.hpp"
#include "cloud.hpp"
#include "ellipsoid_fit.hpp"
#include "fit_programme.hpp"
#include "inside_blocks.hpp"
#include "plane.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>
#include <foam/geometry/internal/bvh.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace foam::inline search::convex {
namespace {

using Kind = Element::Kind;

/// Returns a distance that the point is at least away from the fit; not above 0 inside.
double distance_to(const Fit& fit, const Vec3& p) {
    const Vec3 q = fit.local(p);
    if (fit.kind == Kind::cylinder) {
        return std::max(foam::hypot(q.x, q.y) - fit.radius, std::abs(q.z) - fit.half.z);
    }
    if (fit.kind == Kind::ellipsoid) { // outside, by a factor of the least half axis
        return (reach_of_ellipsoid(fit, q) - 1) * std::min({fit.half.x, fit.half.y, fit.half.z});
    }
    return norm(from_core(fit, q)) - fit.radius;
}

bool holds(const Fit& fit, const Vec3& p) {
    return distance_to(fit, p) <= 0;
}

Fit least_around(Kind kind, const std::vector<Vec3>& points) {
    const Cloud cloud = cloud_of(points);
    Fit fit = least_fit(kind, cloud, Effort::fast, false);
    fit.center = cloud.origin + fit.center * cloud.unit;
    fit.half = fit.half * cloud.unit;
    fit.radius *= cloud.unit;
    return fit;
}

class Descent {
public:
    Descent(const Body& body, const by_spheres::Occupancy& occupancy, std::vector<Fit> fits, bool keep_axes)
        : body_(body), lattice_(occupancy), fits_(std::move(fits)), keep_axes_(keep_axes),
          taken_(body.surface.corners.size(), 0) {
        if (body.is_filled) {
            inside_.emplace(occupancy);
        }
    }

    std::vector<Fit> run(int sweeps, int steps) {
        for (int sweep = 0; sweep < sweeps && fits_.size() > 1; ++sweep) {
            double before = 0, after = 0;
            for (std::size_t i = 0; i < fits_.size();) {
                check_cancelled();
                ++turn_;
                std::vector<Vec3> points = held_alone(i);
                if (points.empty()) {
                    fits_.erase(fits_.begin() + static_cast<std::ptrdiff_t>(i));
                    continue;
                }
                before += look(i);
                if (sweep == 0) { // at first none gives up what another would have to take
                    add_held(i, points);
                }
                after += improve(i, extremes(points), steps, sweep == 0);
                ++i;
            }
            constexpr double gain = 2e-3;
            if (after > before * (1 - gain)) {
                break;
            }
        }
        return std::move(fits_);
    }

private:
    static constexpr double finest = 0.01;        ///< edge of the parts that triangles are cut into, units
    static constexpr double finest_inside = 0.04; ///< edge of the cubes that the inside is cut into, units

    /// Returns whether an element besides this one holds the point.
    bool others_hold(std::size_t i, const Vec3& p) const {
        for (std::size_t k = 0; k < fits_.size(); ++k) {
            if (k != i && holds(fits_[k], p)) {
                return true;
            }
        }
        return false;
    }
    /// Appends the corners of the parts of a triangle that none of the elements named holds alone.
    void add_alone(const std::array<Vec3, 3>& t, std::span<const std::uint32_t> others,
                   std::vector<Vec3>& points) const {
        const auto hold = [&](std::uint32_t k) {
            return holds(fits_[k], t[0]) && holds(fits_[k], t[1]) && holds(fits_[k], t[2]);
        };
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
        const double reach = std::sqrt(
            std::max({squared_norm(t[0] - middle), squared_norm(t[1] - middle), squared_norm(t[2] - middle)}));
        std::array<std::uint32_t, 8> near;
        std::size_t count = 0;
        for (const std::uint32_t k : others) {
            if (distance_to(fits_[k], middle) > reach) {
                continue;
            }
            if (hold(k)) {
                return;
            }
            if (count < near.size()) { // what more would hold counts as not held
                near[count++] = k;
            }
        }
        const auto [length, longest] = longest_side(t);
        if (count == 0 || length < finest) {
            points.insert(points.end(), t.begin(), t.end());
            return;
        }
        const Vec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
        const Vec3 half_way = (a + b) * 0.5;
        add_alone({a, half_way, c}, std::span(near).first(count), points);
        add_alone({half_way, b, c}, std::span(near).first(count), points);
    }
    static std::pair<double, std::size_t> longest_side(const std::array<Vec3, 3>& t) {
        std::size_t longest = 0;
        double length = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            if (const double l = squared_norm(t[(c + 1) % 3] - t[c]); l > length) {
                length = l;
                longest = c;
            }
        }
        return {std::sqrt(length), longest};
    }
    /// Returns the corners of what this element holds alone.
    std::vector<Vec3> held_alone(std::size_t i) {
        std::vector<std::uint32_t> others;
        for (std::uint32_t k = 0; k < fits_.size(); ++k) {
            if (k != i) {
                others.push_back(k);
            }
        }
        std::vector<Vec3> points;
        add_near(i, points, [&](const auto& t, std::vector<Vec3>& found) { add_alone(t, others, found); });
        add_inside_alone(i, points);
        return points;
    }
    /// Appends the corners of what this element holds.
    void add_held(std::size_t i, std::vector<Vec3>& points) {
        add_near(i, points, [&](const auto& t, std::vector<Vec3>& found) { add_held(fits_[i], t, found); });
        add_inside_held(i, points);
    }
    static bool holds_all(const Fit& fit, const Block& block) {
        for (int k = 0; k < 8; ++k) {
            if (!holds(fit, block.corner(k))) {
                return false;
            }
        }
        return true;
    }
    static void add_corners(const Block& block, std::vector<Vec3>& points) {
        for (int k = 0; k < 8; ++k) {
            points.push_back(block.corner(k));
        }
    }
    /// Returns the other elements whose boxes meet that of an element.
    std::vector<std::size_t> overlapping(std::size_t i) const {
        const Box box = bounds(fits_[i]);
        std::vector<std::size_t> found;
        for (std::size_t k = 0; k < fits_.size(); ++k) {
            if (k != i && overlap(bounds(fits_[k]), box)) {
                found.push_back(k);
            }
        }
        return found;
    }
    /// Appends the corners of the parts inside the body that this element holds and none of the others holds alone. A
    /// small part that no element holds alone is to be held by those that hold its middle.
    void add_inside_alone(std::size_t i, std::vector<Vec3>& points) const {
        if (!inside_) {
            return;
        }
        const std::vector<std::size_t> others = overlapping(i);
        inside_->visit([&](const Block& block) {
            const double reach = block.reach(), away = distance_to(fits_[i], block.center);
            if (away > reach) {
                return false;
            }
            bool alone = true;
            for (const std::size_t k : others) {
                if (distance_to(fits_[k], block.center) > reach) {
                    continue;
                }
                if (holds_all(fits_[k], block)) {
                    return false;
                }
                alone = false;
            }
            const bool small = 2 * block.half < finest_inside;
            if (block.full && (alone ? holds_all(fits_[i], block) : small && away <= 0)) {
                add_corners(block, points);
                return false;
            }
            if (block.whole && away <= 0) {
                points.push_back(block.center);
            }
            return !small;
        });
    }
    /// Appends the corners of what this element holds inside the body.
    void add_inside_held(std::size_t i, std::vector<Vec3>& points) const {
        if (!inside_) {
            return;
        }
        inside_->visit([&](const Block& block) {
            if (distance_to(fits_[i], block.center) > block.reach()) {
                return false;
            }
            if (block.full && holds_all(fits_[i], block)) {
                add_corners(block, points);
                return false;
            }
            return 2 * block.half >= finest_inside;
        });
    }
    static void add_held(const Fit& fit, const std::array<Vec3, 3>& t, std::vector<Vec3>& points) {
        if (holds(fit, t[0]) && holds(fit, t[1]) && holds(fit, t[2])) {
            points.insert(points.end(), t.begin(), t.end());
            return;
        }
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
        const double reach = std::sqrt(
            std::max({squared_norm(t[0] - middle), squared_norm(t[1] - middle), squared_norm(t[2] - middle)}));
        const auto [length, longest] = longest_side(t);
        if (length < finest || distance_to(fit, middle) > reach) {
            return;
        }
        const Vec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
        const Vec3 half_way = (a + b) * 0.5;
        add_held(fit, {a, half_way, c}, points);
        add_held(fit, {half_way, b, c}, points);
    }
    /// Appends what add(triangle, found) finds of each triangle near an element. Vertices of triangles that it finds
    /// whole are appended once in a turn.
    template <class Add> void add_near(std::size_t i, std::vector<Vec3>& points, Add add) {
        const std::vector<Vec3>& corners = body_.surface.corners;
        const Box box = bounds(fits_[i]);
        for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
            const std::array<Vec3, 3> triangle{corners[t], corners[t + 1], corners[t + 2]};
            if (!meets(box, triangle)) {
                continue;
            }
            found_.clear();
            add(triangle, found_);
            if (!std::equal(found_.begin(), found_.end(), triangle.begin(), triangle.end())) {
                append_extremes(triangle, points);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::uint32_t& turn = taken_[body_.vertices[t + k]]; turn != turn_) {
                    turn = turn_;
                    points.push_back(triangle[k]);
                }
            }
        }
    }
    /// Appends the corners of the hull of what was found of a triangle. Parts of it have many corners in common.
    void append_extremes(const std::array<Vec3, 3>& t, std::vector<Vec3>& points) const {
        struct Point {
            double x, y;
            Vec3 whole;
        };
        const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
        const int across = std::abs(n.x) > std::abs(n.y) ? (std::abs(n.x) > std::abs(n.z) ? 0 : 2)
                                                         : (std::abs(n.y) > std::abs(n.z) ? 1 : 2);
        if (n[across] == 0) { // a segment
            points.insert(points.end(), found_.begin(), found_.end());
            return;
        }
        std::vector<Point> in_plane;
        for (const Vec3& p : found_) {
            in_plane.push_back({p[(across + 1) % 3], p[(across + 2) % 3], p});
        }
        if (!in_plane.empty()) {
            for (const Point& p : hull_in_plane(in_plane)) {
                points.push_back(p.whole);
            }
        }
    }
    /// Returns the vertices of the hull of the points.
    static Cloud extremes(const std::vector<Vec3>& points) {
        HullOfPoints hull;
        hull.run(points, 2e-6); // what it gives up, the overlap of neighbours holds
        Cloud cloud;
        for (const std::uint32_t v : hull.vertices()) {
            cloud.points.push_back(points[v]);
        }
        return cloud;
    }
    static bool meets(const Box& box, const std::array<Vec3, 3>& t) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::max({t[0][axis], t[1][axis], t[2][axis]}) < box.low[axis] ||
                std::min({t[0][axis], t[1][axis], t[2][axis]}) > box.high[axis]) {
                return false;
            }
        }
        return true;
    }
    /// Looks at the place of an element without it; returns its share of the volume outside.
    double look(std::size_t i) {
        constexpr std::size_t cells = 2000;
        constexpr double margin = 0.1;
        std::vector<Fit> others = fits_;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const Box box = bounds(fits_[i]);
        const Vec3 beyond = Vec3{1, 1, 1} * (margin * box.diagonal());
        Box region;
        region.add(box.low - beyond);
        region.add(box.high + beyond);
        lattice_.look(others, region, cells);
        return lattice_.of({&fits_[i], 1});
    }
    /// Returns the slopes of the element's share of the volume outside.
    Variables slopes(std::size_t i, const Fit& fit) const {
        return boundary_slopes(fit, keep_axes_, [&](const Vec3& p, const Vec3&, double area) {
            const double share = area * lattice_.outside_solid(p);
            return share > 0 && !others_hold(i, p) ? share : 0;
        });
    }
    /// Improves an element beside the others, which look() has seen. Returns its share of the volume outside.
    double improve(std::size_t i, const Cloud& cloud, int most_steps, bool anew) {
        const StepPlan plan{.most = most_steps, .first = 0.05, .longest = 0.1, .shortest = 1e-4, .too_little = 1e-4};
        const auto share = [&](const Fit& fit) { return lattice_.of({&fit, 1}); };
        Fit& fit = fits_[i];
        double least = share(fit);
        if (anew && !keep_axes_) {
            const Fit other = least_around(fit.kind, cloud.points);
            if (const double found = share(other); found < least) {
                fit = other;
                least = found;
            }
        }
        descend(fit, least, cloud, plan, keep_axes_, share, [&](const Fit& f) { return slopes(i, f); });
        return least;
    }

    const Body& body_;
    OutsideLattice lattice_;
    std::optional<InsideBlocks> inside_; ///< of a body that is filled
    std::vector<Fit> fits_;
    const bool keep_axes_;
    std::uint32_t turn_ = 0;           ///< of an element
    std::vector<std::uint32_t> taken_; ///< of each vertex of the surface, the last turn in which it was appended
    std::vector<Vec3> found_;
};

} // namespace

std::vector<Fit> descended_together(const Body& body, const by_spheres::Occupancy& occupancy, std::vector<Fit> fits,
                                    Effort effort, bool keep_axes) {
    const int sweeps = effort == Effort::fast ? 1 : effort == Effort::normal ? 4 : 20;
    const int steps = effort == Effort::fast ? 4 : 10;
    return Descent(body, occupancy, std::move(fits), keep_axes).run(sweeps, steps);
}

} // namespace foam::inline search::convex
