#include "collapse.hpp"

#include <tuple>

namespace foam::simplify {
namespace {

/// Among equal errors (flat regions) short edges go first.
constexpr double length_weight = 1e-6;
/// Planes through boundary edges weigh this much more than triangles (Garland, Heckbert 1997, section 6).
constexpr double boundary_weight = 100;
/// Cosine of the largest turn of a triangle's normal in one collapse.
constexpr double least_cosine = 0.2;

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
    return cross(b - a, c - a);
}

} // namespace

bool Collapse::Candidate::operator>(const Candidate& other) const {
    return std::tie(cost, u, v) > std::tie(other.cost, other.u, other.v);
}

Collapse::Collapse(const Mesh& mesh, const Limits& limits, Context& context)
    : original_(mesh), limits_(limits), context_(context), triangles_(mesh.triangles) {
    const Box box = bounds(mesh);
    const Vec3 size = box.size();
    center_ = box.center();
    scale_ = std::max({size.x, size.y, size.z});
    points_.reserve(mesh.vertices.size());
    for (const Vec3& p : mesh.vertices) {
        points_.push_back((p - center_) / scale_);
    }
    moved_.assign(points_.size(), 0);
    stamp_.assign(points_.size(), 0);
    alive_.assign(triangles_.size(), 1);
    count_ = triangles_.size();
    triangles_of_.resize(points_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (const std::uint32_t corner : triangles_[t]) {
            triangles_of_[corner].push_back(t);
        }
    }
    number_parts();
    compute_quadrics();
}

void Collapse::number_parts() {
    constexpr std::uint32_t none = 0xFFFFFFFFu;
    part_.assign(points_.size(), none);
    std::vector<std::uint32_t> open;
    for (std::uint32_t seed = 0; seed < points_.size(); ++seed) {
        if (part_[seed] != none || triangles_of_[seed].empty()) {
            continue;
        }
        part_[seed] = static_cast<std::uint32_t>(volumes_.size());
        volumes_.push_back(0);
        open.push_back(seed);
        while (!open.empty()) {
            const std::uint32_t vertex = open.back();
            open.pop_back();
            for (const std::uint32_t t : triangles_of_[vertex]) {
                for (const std::uint32_t corner : triangles_[t]) {
                    if (part_[corner] == none) {
                        part_[corner] = part_[seed];
                        open.push_back(corner);
                    }
                }
            }
        }
    }
    for (const auto& [a, b, c] : triangles_) {
        volumes_[part_[a]] += dot(points_[a], cross(points_[b], points_[c])) / 6;
    }
    volumes_before_ = volumes_;
}

bool Collapse::has(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& t = triangles_[triangle];
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Each triangle's plane, weighted by a third of its area, at its corners.
void Collapse::compute_quadrics() {
    quadrics_.resize(points_.size());
    areas_.assign(points_.size(), 0);
    on_boundary_.assign(points_.size(), 0);
    for (const auto& [a, b, c] : triangles_) {
        const Vec3 normal = area_vector(points_[a], points_[b], points_[c]);
        const double area = norm(normal) / 2;
        const Quadric quadric = Quadric::plane(points_[a], normalized(normal), area / 3);
        for (const std::uint32_t corner : {a, b, c}) {
            quadrics_[corner] += quadric;
            areas_[corner] += area / 3;
        }
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
            const bool lonely = std::none_of(triangles_of_[a].begin(), triangles_of_[a].end(),
                                             [&](std::uint32_t other) { return other != t && has(other, b); });
            if (lonely) {
                closed_ = false;
                on_boundary_[a] = on_boundary_[b] = 1;
                const Vec3 edge = points_[b] - points_[a];
                const Vec3 normal =
                    area_vector(points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]);
                const Quadric wall =
                    Quadric::plane(points_[a], normalized(cross(edge, normal)), boundary_weight * squared_norm(edge));
                quadrics_[a] += wall;
                quadrics_[b] += wall;
            }
        }
    }
}

std::vector<std::array<std::uint32_t, 2>> Collapse::edges() const {
    std::vector<std::array<std::uint32_t, 2>> result;
    result.reserve(3 * count_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (std::size_t k = 0; k < 3 && alive_[t]; ++k) {
            const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
            result.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// The point of least error; if it is far off, the best of the ends and the middle.
Vec3 Collapse::placement(std::uint32_t u, std::uint32_t v, double& cost) const {
    Quadric quadric = quadrics_[u];
    quadric += quadrics_[v];
    const Vec3 middle = (points_[u] + points_[v]) * 0.5;
    const double length = distance(points_[u], points_[v]);
    Vec3 best = quadric.minimizer(middle);
    if (!(distance(best, middle) <= 2 * length)) {
        best = middle;
        for (const Vec3& end : {points_[u], points_[v]}) {
            if (quadric.error(end) < quadric.error(best)) {
                best = end;
            }
        }
    }
    cost = quadric.error(best) + length_weight * length * length * (areas_[u] + areas_[v]);
    return best;
}

void Collapse::propose(std::uint32_t u, std::uint32_t v) {
    double cost = 0;
    placement(u, v, cost);
    const std::uint32_t low = std::min(u, v), high = std::max(u, v);
    queue_.push({cost, low, high, stamp_[low], stamp_[high]});
}

std::vector<std::uint32_t> Collapse::ring(std::uint32_t vertex) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t t : triangles_of_[vertex]) {
        for (const std::uint32_t corner : triangles_[t]) {
            if (corner != vertex) {
                result.push_back(corner);
            }
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// The link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999): the neighbours that u and v share are exactly the tips
/// of the triangles on the edge, and these tips are not joined to both of them by another pair of triangles.
bool Collapse::keeps_topology(std::uint32_t u, std::uint32_t v) const {
    std::vector<std::uint32_t> tips;
    for (const std::uint32_t t : triangles_of_[u]) {
        if (has(t, v)) {
            for (const std::uint32_t corner : triangles_[t]) {
                if (corner != u && corner != v) {
                    tips.push_back(corner);
                }
            }
        }
    }
    if (tips.size() == 2 && on_boundary_[u] && on_boundary_[v]) {
        return false;
    }
    const std::vector<std::uint32_t> ring_u = ring(u), ring_v = ring(v);
    std::vector<std::uint32_t> shared;
    std::set_intersection(ring_u.begin(), ring_u.end(), ring_v.begin(), ring_v.end(), std::back_inserter(shared));
    if (shared.size() != tips.size()) {
        return false;
    }
    const auto joins_tips = [&](std::uint32_t t) { return has(t, tips[0]) && has(t, tips[1]); };
    return tips.size() < 2 || (std::none_of(triangles_of_[u].begin(), triangles_of_[u].end(), joins_tips) ||
                               std::none_of(triangles_of_[v].begin(), triangles_of_[v].end(), joins_tips));
}

bool Collapse::stays_near(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    Quadric quadric = quadrics_[u];
    quadric += quadrics_[v];
    const double limit = limits_.plane_distance / scale_;
    return quadric.error(to) <= limit * limit * (areas_[u] + areas_[v]);
}

/// No triangle that stays turns over or becomes a needle.
bool Collapse::keeps_shape(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    for (const std::uint32_t vertex : {u, v}) {
        for (const std::uint32_t t : triangles_of_[vertex]) {
            if (has(t, u) && has(t, v)) {
                continue;
            }
            std::array<Vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = points_[triangles_[t][k]];
            }
            const Vec3 before = area_vector(p[0], p[1], p[2]);
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = triangles_[t][k] == vertex ? to : p[k];
            }
            const Vec3 after = area_vector(p[0], p[1], p[2]);
            const double longest =
                std::max({squared_norm(p[1] - p[0]), squared_norm(p[2] - p[1]), squared_norm(p[0] - p[2])});
            if (!(norm(after) > 1e-3 * longest) && !(norm(after) > norm(before))) {
                return false;
            }
            if (squared_norm(before) > 0 && !(dot(before, after) > least_cosine * norm(before) * norm(after))) {
                return false;
            }
        }
    }
    return true;
}

/// Change of the volume under the triangles at u and v when both move to `to`; exact for a closed mesh.
double Collapse::volume_gain(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    const auto six_volumes = [&](std::uint32_t t, bool moved) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = triangles_[t][k];
            p[k] = (moved && (corner == u || corner == v) ? to : points_[corner]) - to;
        }
        return dot(p[0], cross(p[1], p[2]));
    };
    double gain = 0;
    for (const std::uint32_t t : triangles_of_[u]) {
        gain += six_volumes(t, true) - six_volumes(t, false);
    }
    for (const std::uint32_t t : triangles_of_[v]) {
        gain += has(t, u) ? 0 : six_volumes(t, true) - six_volumes(t, false);
    }
    return gain / 6;
}

bool Collapse::try_collapse(const Candidate& candidate) {
    const std::uint32_t u = candidate.u, v = candidate.v;
    double cost = 0;
    const Vec3 to = placement(u, v, cost);
    if (!stays_near(u, v, to) || !keeps_topology(u, v) || !keeps_shape(u, v, to)) {
        return false;
    }
    const double gain = closed_ ? volume_gain(u, v, to) : 0;
    const double before = volumes_before_[part_[u]];
    if (std::abs(volumes_[part_[u]] + gain - before) > limits_.volume_change * std::abs(before)) {
        return false;
    }
    volumes_[part_[u]] += gain;
    points_[u] = to;
    moved_[u] = 1;
    on_boundary_[u] = on_boundary_[u] || on_boundary_[v];
    quadrics_[u] += quadrics_[v];
    areas_[u] += areas_[v];
    for (const std::uint32_t t : triangles_of_[v]) {
        if (has(t, u)) {
            alive_[t] = 0;
            --count_;
            for (const std::uint32_t corner : triangles_[t]) {
                if (corner != v) {
                    std::erase(triangles_of_[corner], t);
                }
            }
        } else {
            std::replace(triangles_[t].begin(), triangles_[t].end(), v, u);
            triangles_of_[u].push_back(t);
        }
    }
    triangles_of_[v].clear();
    ++stamp_[u];
    ++stamp_[v];
    for (const std::uint32_t neighbour : ring(u)) {
        propose(u, neighbour);
    }
    return true;
}

Mesh Collapse::run() {
    // An edge that may not go is looked at again in a next pass, after its surroundings have changed.
    for (bool progress = true; progress && count_ > limits_.triangles;) {
        progress = false;
        queue_ = {};
        for (const auto& [u, v] : edges()) {
            propose(u, v);
        }
        for (std::size_t step = 0; !queue_.empty() && count_ > limits_.triangles; ++step) {
            if (step % 4096 == 0) {
                context_.check_cancelled();
            }
            const Candidate candidate = queue_.top();
            queue_.pop();
            if (stamp_[candidate.u] == candidate.stamp_u && stamp_[candidate.v] == candidate.stamp_v) {
                progress |= try_collapse(candidate);
            }
        }
    }
    return result();
}

Mesh Collapse::result() const {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    Mesh mesh;
    std::vector<std::uint32_t> number(points_.size(), unused);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        if (!triangles_of_[i].empty()) {
            number[i] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(moved_[i] ? points_[i] * scale_ + center_ : original_.vertices[i]);
        }
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (alive_[t]) {
            const auto& [a, b, c] = triangles_[t];
            mesh.triangles.push_back({number[a], number[b], number[c]});
        }
    }
    return mesh;
}

} // namespace foam::simplify
