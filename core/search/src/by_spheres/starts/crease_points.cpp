#include "by_spheres/starts/starts.hpp"

#include "by_spheres/moves/remainder.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/surface_runs.hpp>
#include <foam/geometry/internal/triangles.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>

namespace foam::inline search::by_spheres {
namespace {

using geometry::Corners;

bool holds(const Sphere& s, const Vec3& p) {
    return squared_norm(p - s.center) <= s.radius * s.radius;
}
bool holds(const Sphere& s, const Corners& t) {
    return holds(s, t.a) && holds(s, t.b) && holds(s, t.c);
}

PieceCorner piece_corner(const Vec3& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

} // namespace

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
static std::vector<SurfacePiece> not_in_one(const Solid& solid, const Frame& frame,
                                            const std::vector<Sphere>& spheres) {
    constexpr std::size_t at_once = 32; // consecutive runs are close together
    constexpr double rounding = 1e-9;   // units
    const geometry::SurfaceRuns& runs = geometry::surface_runs(solid);
    const Mesh& surface = solid.surface();
    std::vector<SurfacePiece> open;
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
                    open.push_back({i, {piece_corner(corners.a), piece_corner(corners.b), piece_corner(corners.c)}});
                }
            }
        }
    }
    return open;
}

Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most) {
    constexpr std::size_t pieces_per_point = 30; // of which one is taken
    constexpr double smallest = 1e-6;
    const std::size_t too_many = pieces_per_point * most;
    const std::vector<SurfacePiece> triangles = not_in_one(solid, frame, unit_spheres(balls));
    auto length = static_cast<float>(std::max(finest, smallest));
    std::optional<std::vector<SurfacePiece>> open;
    while (!(open = open_pieces(triangles, balls, length, too_many))) {
        check_cancelled();
        length *= 2; // much of the surface is open: a coarse result is enough
    }
    std::ranges::stable_sort(*open, {}, &SurfacePiece::triangle);
    const std::size_t count = std::min(most, open->size());
    Points some;
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [a, b, c] = (*open)[i * open->size() / count].corners;
        some.add({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3});
    }
    return some;
}

WaitingPoints::WaitingPoints(const Points& all, std::size_t begin) : all_(all) {
    for (std::size_t i = begin; i < all.size(); ++i) {
        waiting_.push_back({static_cast<std::uint32_t>(i), 0});
    }
}

void WaitingPoints::add_outside(const Balls& balls, Points& active) {
    std::size_t left = 0;
    CancellationCounter often(256);
    for (const Waiting& w : waiting_) {
        often.check();
        if (const auto owner = owner_of(w, balls)) {
            waiting_[left++] = {w.point, *owner};
        } else {
            active.add(all_, w.point);
        }
    }
    waiting_.resize(left);
}

std::optional<std::uint32_t> WaitingPoints::owner_of(const Waiting& waiting, const Balls& balls) const {
    const float x = all_.x[waiting.point], y = all_.y[waiting.point], z = all_.z[waiting.point];
    const auto held = [&](const Ball& b) { return b.squared_distance(x, y, z) <= b.r * b.r; };
    if (held(balls[waiting.owner])) {
        return waiting.owner;
    }
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        if (held(balls[i])) {
            return i;
        }
    }
    return std::nullopt;
}

} // namespace foam::inline search::by_spheres
