#include <foam/geometry/internal/quickhull.hpp>

#include "mesh/orient3d.hpp"

namespace foam::inline geometry {
namespace {

template <class Measure> std::uint32_t largest(std::span<const Vec3> points, Measure measure) {
    std::uint32_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const double value = measure(points[i]);
        if (value > most) {
            most = value;
            best = i;
        }
    }
    return best;
}

} // namespace

Quickhull::Quickhull(std::span<const Vec3> points, double size, double tolerance)
    : points_(points), size_(size), tolerance_(tolerance), next_(points.size(), none), begin_(points.size(), none) {}

bool Quickhull::first_tetrahedron(std::array<std::uint32_t, 4>& corners) const {
    std::array<std::uint32_t, 6> extreme{}; // lowest and highest along each axis
    for (std::uint32_t i = 1; i < points_.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(2 * axis);
            if (points_[i][axis] < points_[extreme[at]][axis]) {
                extreme[at] = i;
            } else if (points_[i][axis] > points_[extreme[at + 1]][axis]) {
                extreme[at + 1] = i;
            }
        }
    }
    double longest = -1;
    for (std::size_t i = 0; i < extreme.size(); ++i) {
        for (std::size_t k = i + 1; k < extreme.size(); ++k) {
            const double squared = squared_norm(points_[extreme[i]] - points_[extreme[k]]);
            if (squared > longest) {
                longest = squared;
                corners[0] = extreme[i];
                corners[1] = extreme[k];
            }
        }
    }
    const Vec3 a = points_[corners[0]], along = normalized(points_[corners[1]] - a);
    corners[2] = largest(points_, [&](const Vec3& p) { return squared_norm(cross(p - a, along)); });
    const Vec3 c = points_[corners[2]], normal = normalized(cross(points_[corners[1]] - a, c - a));
    corners[3] = largest(points_, [&](const Vec3& p) { return std::abs(dot(p - a, normal)); });
    const Vec3 p = points_[corners[3]];
    if (!(std::abs(dot(p - a, normal)) > tolerance_)) {
        return false;
    }
    const int side = orient3d(a, points_[corners[1]], c, p);
    if (side > 0) {
        std::swap(corners[0], corners[1]);
    }
    return side != 0;
}

/// The normal comes from differences of corners, with an error of less than 8 u |v| |w| / |v × w| + 4 u; the rest is
/// for rounding of the distance itself.
std::uint32_t Quickhull::make(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3 &at = points_[a], v = points_[b] - at, w = points_[c] - at, n = cross(v, w);
    const double length = norm(n);
    const std::uint32_t i = place_for_triangle();
    HullTriangle& t = triangles_[i]; // in place: a copy would wait for what was just written
    t.corners = {a, b, c};
    t.at = at;
    t.normal = length > 0 ? n / length : Vec3{};
    t.error = size_ * 16 * unit_roundoff *
              (1 + (length > 0 ? std::sqrt(squared_norm(v) * squared_norm(w)) / length : 1 / unit_roundoff));
    states_[i] = {.two_areas = length, .alive = true};
    return i;
}

std::uint32_t Quickhull::place_for_triangle() {
    if (free_.empty()) {
        triangles_.emplace_back();
        states_.emplace_back();
        return static_cast<std::uint32_t>(triangles_.size() - 1);
    }
    const std::uint32_t i = free_.back();
    free_.pop_back();
    return i;
}

int Quickhull::side(std::uint32_t triangle, const Vec3& p) const {
    const HullTriangle& t = triangles_[triangle];
    const double d = distance(t, p);
    if (std::abs(d) > t.error) {
        return d > 0 ? 1 : -1;
    }
    return orient3d(points_[t.corners[0]], points_[t.corners[1]], points_[t.corners[2]], p);
}

void Quickhull::give(std::uint32_t triangle, std::uint32_t point, double height) {
    State& state = states_[triangle];
    if (state.first == none) {
        waiting_.push_back(triangle);
    }
    next_[point] = state.first;
    state.first = point;
    if (height > state.height) { // of the first, too: it is above the tolerance
        state.farthest = point;
        state.height = height;
    }
}

bool Quickhull::is_corner(const Vec3& p, std::uint32_t triangle) const {
    const std::array<std::uint32_t, 3>& corners = triangles_[triangle].corners;
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return points_[c] == p; });
}

/// Gives the point to one of the triangles that it is above. If it is above none of them it is in the hull.
void Quickhull::place(std::uint32_t point, std::span<const std::uint32_t> among) {
    const Vec3& p = points_[point];
    std::uint32_t near = none;
    for (const std::uint32_t i : among) {
        const double d = distance(triangles_[i], p);
        if (d > tolerance_ && (d > triangles_[i].error || side(i, p) > 0)) {
            give(i, point, d);
            return;
        }
        near = d > -triangles_[i].error ? i : near;
    }
    if (near != none && !is_corner(p, near)) {
        place_beyond(point, near);
    }
}

/// Looks for a triangle that the point is well above among those that it may be above, which are connected.
void Quickhull::place_beyond(std::uint32_t point, std::uint32_t start) {
    const Vec3& p = points_[point];
    ++stamp_;
    states_[start].seen = stamp_;
    looked_at_.assign(1, start);
    while (!looked_at_.empty()) {
        const std::uint32_t i = looked_at_.back();
        looked_at_.pop_back();
        for (const std::uint32_t k : triangles_[i].across) {
            if (states_[k].seen == stamp_) {
                continue;
            }
            states_[k].seen = stamp_;
            const double d = distance(triangles_[k], p);
            if (d > tolerance_ && (d > triangles_[k].error || side(k, p) > 0)) {
                give(k, point, d);
                return;
            }
            if (d > -triangles_[k].error) {
                looked_at_.push_back(k);
            }
        }
    }
    near_.push_back(point);
}

void Quickhull::find_visible(std::uint32_t start, const Vec3& apex) {
    ++stamp_;
    visible_.assign(1, start);
    horizon_.clear();
    states_[start].alive = false;
    for (std::size_t n = 0; n < visible_.size(); ++n) {
        const HullTriangle& t = triangles_[visible_[n]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t beyond = t.across[k];
            if (!states_[beyond].alive) {
                continue;
            }
            if (states_[beyond].seen != stamp_) {
                if (side(beyond, apex) > 0) {
                    states_[beyond].alive = false;
                    visible_.push_back(beyond);
                    continue;
                }
                states_[beyond].seen = stamp_;
            }
            horizon_.push_back({t.corners[k], t.corners[(k + 1) % 3], beyond});
        }
    }
}

/// Replaces the visible triangles by those from the horizon to the apex.
void Quickhull::replace_visible(std::uint32_t apex) {
    made_.clear();
    for (const HorizonEdge& edge : horizon_) {
        const std::uint32_t i = make(edge.from, edge.to, apex);
        made_.push_back(i);
        begin_[edge.from] = i;
        triangles_[i].across[0] = edge.beyond;
        HullTriangle& beyond = triangles_[edge.beyond];
        for (std::size_t k = 0; k < 3; ++k) {
            if (beyond.corners[k] == edge.to) {
                beyond.across[k] = i;
            }
        }
    }
    for (const std::uint32_t i : made_) {
        const std::uint32_t next = begin_[triangles_[i].corners[1]];
        triangles_[i].across[1] = next;
        triangles_[next].across[2] = i;
    }
}

bool Quickhull::begin() {
    std::array<std::uint32_t, 4> c{};
    if (points_.size() < 4 || !first_tetrahedron(c)) {
        return false;
    }
    // From the fourth corner, the first three go clockwise.
    made_ = {make(c[0], c[1], c[2]), make(c[0], c[3], c[1]), make(c[1], c[3], c[2]), make(c[2], c[3], c[0])};
    triangles_[0].across = {1, 2, 3};
    triangles_[1].across = {3, 2, 0};
    triangles_[2].across = {1, 3, 0};
    triangles_[3].across = {2, 1, 0};
    six_volumes_ = -distance(triangles_[0], points_[c[3]]) * states_[0].two_areas;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        if (std::find(c.begin(), c.end(), i) == c.end()) {
            place(i, made_);
        }
    }
    return true;
}

bool Quickhull::grow() {
    while (turn_ < waiting_.size()) {
        const std::uint32_t next = waiting_[turn_++];
        if (has_points(next)) {
            add_corner(next);
            return true;
        }
    }
    return false;
}

/// Adds the point that is farthest above a triangle.
void Quickhull::add_corner(std::uint32_t triangle) {
    asking_.check();
    const std::uint32_t apex = states_[triangle].farthest;
    find_visible(triangle, points_[apex]);
    replace_visible(apex);
    open_.clear();
    for (const std::uint32_t i : visible_) {
        six_volumes_ += distance(triangles_[i], points_[apex]) * states_[i].two_areas;
        for (std::uint32_t p = states_[i].first; p != none; p = next_[p]) {
            open_.push_back(p);
        }
        states_[i].first = none;
    }
    for (const std::uint32_t p : open_) {
        if (p != apex) {
            place(p, made_);
        }
    }
    free_.insert(free_.end(), visible_.begin(), visible_.end());
}

bool Quickhull::run() {
    if (!begin()) {
        return false;
    }
    while (!waiting_.empty()) {
        const std::uint32_t last = waiting_.back();
        waiting_.pop_back();
        if (has_points(last)) {
            add_corner(last);
        }
    }
    drop_dead();
    return true;
}

void Quickhull::drop_dead() {
    std::vector<std::uint32_t> place(triangles_.size(), none);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        place[i] = states_[i].alive ? count++ : none;
    }
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (states_[i].alive) {
            triangles_[place[i]] = triangles_[i];
        }
    }
    triangles_.resize(count);
    for (HullTriangle& t : triangles_) {
        for (std::uint32_t& k : t.across) {
            k = place[k];
        }
    }
}

} // namespace foam::geometry
