#include "proof/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

void PlacedPiece::measure() {
    box = {};
    middle = {};
    for (const Vec3& p : points) {
        box.add(p);
        middle += p;
    }
    middle = middle / static_cast<double>(points.size());
    double squared = 0;
    for (const Vec3& p : points) {
        squared = std::max(squared, squared_norm(p - middle));
    }
    radius = std::sqrt(squared);
}

double PlacedPiece::least_along(const Vec3& slope) const {
    double least = infinity;
    for (const Vec3& p : points) {
        least = std::min(least, dot(slope, p - middle));
    }
    return least;
}

Walls::Walls(std::span<const Element> elements, const Bodies& bodies) : elements_(elements), bodies_(bodies) {
    for (std::uint32_t k = 0; k < elements_.size(); ++k) {
        planes_.emplace_back(bodies_.planes(k).begin(), bodies_.planes(k).end());
        for (Polytope::Face& face : planes_.back()) {
            face.offset += dot(face.normal, bodies_.center(k));
        }
    }
}

double Walls::value(std::uint32_t k, const Vec3& p, Vec3& slope) const {
    if (!planes_[k].empty()) {
        double most = -infinity;
        for (const Polytope::Face& face : planes_[k]) {
            const double beyond = dot(face.normal, p) - face.offset;
            if (beyond > most) {
                most = beyond;
                slope = face.normal;
            }
        }
        return most;
    }
    double most = value_of(k, p, slope);
    if (elements_[k].kind == Element::Kind::cylinder) {
        const Vec3& axis = bodies_.axis(k, 2);
        const double along = dot(axis, p - bodies_.center(k)), beyond = std::abs(along) - elements_[k].half.z;
        if (beyond > most) {
            most = beyond;
            slope = axis * std::copysign(1.0, along);
        }
    }
    return most;
}

bool Walls::is_clear(const PlacedPiece& patch, std::uint32_t k) const {
    const double room = patch.radius + margin_of(k);
    if (!planes_[k].empty()) {
        return std::any_of(planes_[k].begin(), planes_[k].end(), [&](const Polytope::Face& face) {
            return dot(face.normal, patch.middle) - face.offset > room;
        });
    }
    return value_of(k, patch.middle) > room;
}

bool Walls::add(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const {
    const std::size_t first = walls.size();
    add_all(patch, k, walls);
    const auto lower = [](const Wall& a, const Wall& b) { return a.low < b.low; };
    const auto best = std::max_element(walls.begin() + static_cast<std::ptrdiff_t>(first), walls.end(), lower);
    if (best == walls.end() || !(best->low > 0)) {
        return true;
    }
    walls[first] = *best;
    walls.resize(first + 1);
    return false;
}

void Walls::add_all(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const {
    const Element& e = elements_[k];
    switch (e.kind) {
    case Element::Kind::box:
    case Element::Kind::hull:
        for (const Polytope::Face& face : planes_[k]) {
            add_plane(patch, k, face.normal, face.offset, walls);
        }
        return;
    case Element::Kind::cylinder: {
        add_plane_pair(patch, k, 2, e.half.z, walls);
        add_round(patch, k, walls);
        return;
    }
    case Element::Kind::swept_box: {
        for (int axis = 0; axis < 3; ++axis) {
            add_plane_pair(patch, k, axis, e.half[axis] + e.radius, walls);
        }
        const bool on_face = k == patch.element && patch.normals.empty();
        if (!on_face && is_near_edge(patch, k)) {
            add_round(patch, k, walls);
        }
        return;
    }
    case Element::Kind::sphere:
    case Element::Kind::capsule:
    case Element::Kind::ellipsoid:
        add_round(patch, k, walls);
    }
}

/// Adds those of the two planes across an axis of the element that are near, at a distance from its middle.
void Walls::add_plane_pair(const PlacedPiece& patch, std::uint32_t k, int axis, double reach,
                           std::vector<Wall>& walls) const {
    const Vec3& normal = bodies_.axis(k, axis);
    const double middle = dot(normal, bodies_.center(k));
    add_plane(patch, k, normal, middle + reach, walls);
    add_plane(patch, k, -normal, -middle + reach, walls);
}

void Walls::add_plane(const PlacedPiece& patch, std::uint32_t k, const Vec3& normal, double offset,
                      std::vector<Wall>& walls) const {
    const double margin = margin_of(k);
    if (dot(normal, patch.middle) - offset + patch.radius < -2 * margin) {
        return;
    }
    double low = infinity, high = -infinity;
    for (const Vec3& p : patch.points) {
        const double value = dot(normal, p) - offset;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (high > -margin) {
        walls.push_back({k, true, normal, low - margin, 0});
    }
}

void Walls::add_round(const PlacedPiece& patch, std::uint32_t k, std::vector<Wall>& walls) const {
    const double margin = margin_of(k);
    Wall wall{k, false, {}, 0, 0};
    const double here = value_of(k, patch.middle, wall.normal);
    const Element& e = elements_[k];
    if (e.kind == Element::Kind::cylinder || e.kind == Element::Kind::swept_box) { // not the only wall
        double high = -infinity;
        for (const Vec3& p : patch.points) {
            high = std::max(high, value_of(k, p));
        }
        if (!(high > -margin)) {
            return;
        }
    }
    const double least_radius =
        e.kind == Element::Kind::ellipsoid ? std::min({e.half.x, e.half.y, e.half.z}) : e.radius;
    wall.turn = std::min(1.0, patch.radius / least_radius);
    wall.low = here + patch.least_along(wall.normal) - margin;
    walls.push_back(wall);
}

/// Returns whether a point of the patch may be beside an edge of a swept box: beyond its core along two axes.
bool Walls::is_near_edge(const PlacedPiece& patch, std::uint32_t k) const {
    const Element& e = elements_[k];
    Box box;
    for (const Vec3& p : patch.points) {
        box.add(bodies_.local(k, p));
    }
    int beyond = 0;
    for (int axis = 0; axis < 3; ++axis) {
        beyond += std::max(box.high[axis], -box.low[axis]) > e.half[axis] - margin_of(k);
    }
    return beyond >= 2;
}

/// Returns the value of an element's round wall: at most the distance, and convex. Sets `slope` to its gradient.
double Walls::value_of(std::uint32_t k, const Vec3& p, Vec3& slope) const {
    const Element& e = elements_[k];
    if (e.kind == Element::Kind::sphere) {
        const Vec3 q = p - bodies_.center(k);
        const double length = norm(q);
        slope = length > 0 ? q / length : q;
        return length - e.radius;
    }
    const Vec3 q = bodies_.local(k, p);
    if (e.kind == Element::Kind::ellipsoid) {
        const Vec3 u{q.x / e.half.x, q.y / e.half.y, q.z / e.half.z};
        const double least = std::min({e.half.x, e.half.y, e.half.z}), length = norm(u);
        slope = length > 0 ? bodies_.turned(k, Vec3{u.x / e.half.x, u.y / e.half.y, u.z / e.half.z} * (least / length))
                           : Vec3{};
        return (length - 1) * least;
    }
    Vec3 out{q.x, q.y, 0};
    if (e.kind != Element::Kind::cylinder) {
        for (int axis = 0; axis < 3; ++axis) {
            out[axis] = q[axis] - std::clamp(q[axis], -e.half[axis], e.half[axis]);
        }
        if (out == Vec3{}) { // in the core
            int nearest = 0;
            for (int axis = 1; axis < 3; ++axis) {
                nearest = std::abs(q[axis]) - e.half[axis] > std::abs(q[nearest]) - e.half[nearest] ? axis : nearest;
            }
            out[nearest] = std::copysign(1.0, q[nearest]);
            slope = bodies_.turned(k, out);
            return std::abs(q[nearest]) - e.half[nearest] - e.radius;
        }
    }
    const double length = norm(out);
    slope = length > 0 ? bodies_.turned(k, out / length) : Vec3{};
    return length - e.radius;
}

bool Walls::grows(const PlacedPiece& patch, const Wall& wall, const Vec3& way) const {
    if (wall.flat) {
        constexpr double rounding = 1e-15;
        return dot(wall.normal, way) >= -rounding * norm(way);
    }
    if (wall.element == patch.element && !patch.normals.empty()) {
        return std::all_of(patch.normals.begin(), patch.normals.end(), [&](const Vec3& n) { return dot(n, way) >= 0; });
    }
    return dot(wall.normal, way) > 0 && grows_round(patch, wall, way);
}

/// A convex f grows from x on if f(x) >= f(x - v) for some v along the way. The square of the distance from a point or
/// an axis does so if the way leads away from it: a test that is linear in x. For others, at the middle c, f(x) >= f(c)
/// + slope · (x - c), and f(x - v) is at most the mean of its values at the corners p - v that makes x a mean of the
/// corners p.
bool Walls::grows_round(const PlacedPiece& patch, const Wall& wall, const Vec3& way) const {
    const std::uint32_t k = wall.element;
    const Element& e = elements_[k];
    const double margin = margin_of(k), length = norm(way);
    if (e.kind == Element::Kind::sphere || e.kind == Element::Kind::cylinder || e.kind == Element::Kind::ellipsoid) {
        Vec3 along = way;
        double room = margin * length;
        if (e.kind == Element::Kind::cylinder) {
            const Vec3& axis = bodies_.axis(k, 2);
            along = way - axis * dot(axis, way);
        } else if (e.kind == Element::Kind::ellipsoid) {
            const auto part = [&](int axis) { return dot(bodies_.axis(k, axis), way) / (e.half[axis] * e.half[axis]); };
            along = bodies_.turned(k, {part(0), part(1), part(2)});
            room = margin * norm(along);
        }
        const Vec3 center = bodies_.center(k);
        return std::all_of(patch.points.begin(), patch.points.end(),
                           [&](const Vec3& p) { return dot(p - center, along) > room; });
    }
    constexpr int tries = 4;
    const double here = value_of(k, patch.middle);
    const Vec3 direction = normalized(way);
    const double along = dot(wall.normal, direction);
    Vec3 back = direction * std::max({length, patch.width_along(direction), 2 * margin / along});
    for (int i = 0; i < tries; ++i, back *= 4) {
        const auto grows_by = [&](const Vec3& p) {
            return here + dot(wall.normal, p - patch.middle) - value_of(k, p - back) >= margin;
        };
        if (std::all_of(patch.points.begin(), patch.points.end(), grows_by)) {
            return true;
        }
    }
    return false;
}

double Walls::length_beyond(const PlacedPiece& patch, const Wall& wall, const Vec3& direction, double step) const {
    if (wall.low > 0) {
        return 0;
    }
    const double along = dot(wall.normal, direction), margin = margin_of(wall.element);
    if (!(along > 0)) {
        return infinity;
    }
    if (wall.flat) {
        return (-wall.low + margin) / along;
    }
    constexpr int doublings = 5;
    double length = std::max(step, (-wall.low + margin) / along);
    for (int i = 0; i < doublings; ++i, length *= 2) {
        Vec3 slope;
        const double there = value_of(wall.element, patch.middle + direction * length, slope);
        if (there + patch.least_along(slope) > margin) {
            return length;
        }
    }
    return infinity;
}

} // namespace foam::inline geometry
