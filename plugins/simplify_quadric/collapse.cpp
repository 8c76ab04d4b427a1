#include "collapse.hpp"

#include <foam/geometry/mesh_checks.hpp>

namespace foam::simplify {
namespace {

/// Weight of the length: among equal errors (flat regions) short edges collapse first.
constexpr double length_weight = 1e-6;
/// Weight of planes through boundary edges relative to triangles (Garland, Heckbert 1997, section 6).
constexpr double boundary_weight = 100;
/// Cosine of the largest rotation of a triangle's normal in one collapse.
constexpr double least_cosine = 0.2;

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
    return cross(b - a, c - a);
}

} // namespace

Collapse::Collapse(const Mesh& mesh, const Limits& limits, Context& context)
    : original_(mesh), limits_(limits), context_(context), triangles_(mesh.triangles) {
    const Box box = bounds(mesh);
    const Vec3 size = box.size();
    center_ = box.center();
    scale_ = std::max({size.x, size.y, size.z});
    vertices_.reserve(mesh.vertices.size());
    for (const Vec3& p : mesh.vertices) {
        vertices_.push_back({.point = (p - center_) / scale_});
    }
    alive_.assign(triangles_.size(), 1);
    count_ = triangles_.size();
    triangles_of_.resize(vertices_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (const std::uint32_t corner : triangles_[t]) {
            triangles_of_[corner].push_back(t);
        }
    }
    context_.check_cancelled();
    number_parts();
    context_.check_cancelled();
    compute_quadrics();
}

void Collapse::number_parts() {
    constexpr std::uint32_t none = 0xFFFFFFFFu;
    for (Vertex& vertex : vertices_) {
        vertex.part = none;
    }
    std::vector<std::uint32_t> open;
    for (std::uint32_t seed = 0; seed < vertices_.size(); ++seed) {
        if (vertices_[seed].part != none || triangles_of_[seed].empty()) {
            continue;
        }
        vertices_[seed].part = static_cast<std::uint32_t>(volumes_.size());
        volumes_.push_back(0);
        open.push_back(seed);
        while (!open.empty()) {
            const std::uint32_t vertex = open.back();
            open.pop_back();
            for (const std::uint32_t t : triangles_of_[vertex]) {
                for (const std::uint32_t corner : triangles_[t]) {
                    if (vertices_[corner].part == none) {
                        vertices_[corner].part = vertices_[seed].part;
                        open.push_back(corner);
                    }
                }
            }
        }
    }
    for (const auto& [a, b, c] : triangles_) {
        volumes_[vertices_[a].part] += dot(vertices_[a].point, cross(vertices_[b].point, vertices_[c].point)) / 6;
    }
    volumes_before_ = volumes_;
}

bool Collapse::has(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& t = triangles_[triangle];
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
}

/// Adds each triangle's plane, weighted by a third of its area, to its corners.
void Collapse::compute_quadrics() {
    for (const auto& [a, b, c] : triangles_) {
        const Vec3 normal = area_vector(vertices_[a].point, vertices_[b].point, vertices_[c].point);
        const double area = norm(normal) / 2;
        const Quadric quadric = Quadric::plane(vertices_[a].point, normalized(normal), area / 3);
        for (const std::uint32_t corner : {a, b, c}) {
            vertices_[corner].quadric += quadric;
            vertices_[corner].area += area / 3;
        }
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        if (t % 65536 == 0) {
            context_.check_cancelled();
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
            const bool lonely = std::none_of(triangles_of_[a].begin(), triangles_of_[a].end(),
                                             [&](std::uint32_t other) { return other != t && has(other, b); });
            if (lonely) {
                closed_ = false;
                vertices_[a].on_boundary = vertices_[b].on_boundary = 1;
                const Vec3 edge = vertices_[b].point - vertices_[a].point;
                const Vec3 normal = area_vector(vertices_[triangles_[t][0]].point, vertices_[triangles_[t][1]].point,
                                                vertices_[triangles_[t][2]].point);
                const Quadric wall = Quadric::plane(vertices_[a].point, normalized(cross(edge, normal)),
                                                    boundary_weight * squared_norm(edge));
                vertices_[a].quadric += wall;
                vertices_[b].quadric += wall;
            }
        }
    }
}

std::vector<Candidate> Collapse::candidates() const {
    std::vector<Candidate> result;
    result.reserve(3 * count_ / 2);
    for_each_edge(sides_by_edge(triangles_, vertices_.size(), alive_),
                  [&](std::span<const Side> edge) { result.push_back(candidate(edge[0].low, edge[0].high)); });
    return result;
}

/// Returns the point of least error; if it is far away, the best of the ends and the middle.
Vec3 Collapse::placement(std::uint32_t u, std::uint32_t v, double& cost) const {
    Quadric quadric = vertices_[u].quadric;
    quadric += vertices_[v].quadric;
    const Vec3 middle = (vertices_[u].point + vertices_[v].point) * 0.5;
    const double length = distance(vertices_[u].point, vertices_[v].point);
    Vec3 best = quadric.minimizer(middle);
    if (!(distance(best, middle) <= 2 * length)) {
        best = middle;
        for (const Vec3& end : {vertices_[u].point, vertices_[v].point}) {
            if (quadric.error(end) < quadric.error(best)) {
                best = end;
            }
        }
    }
    cost = quadric.error(best) + length_weight * length * length * (vertices_[u].area + vertices_[v].area);
    return best;
}

Candidate Collapse::candidate(std::uint32_t u, std::uint32_t v) const {
    double cost = 0;
    placement(u, v, cost);
    const std::uint32_t low = std::min(u, v), high = std::max(u, v);
    return {cost, low, high, vertices_[low].stamp, vertices_[high].stamp};
}

bool Collapse::is_stale(const Candidate& candidate) const {
    return vertices_[candidate.u].stamp != candidate.stamp_u || vertices_[candidate.v].stamp != candidate.stamp_v;
}

/// Visits each neighbour once; marks them with a new walk_.
template <class Visit> void Collapse::for_each_neighbour(std::uint32_t vertex, Visit visit) {
    ++walk_;
    for (const std::uint32_t t : triangles_of_[vertex]) {
        for (const std::uint32_t corner : triangles_[t]) {
            if (corner != vertex && vertices_[corner].mark != walk_) {
                vertices_[corner].mark = walk_;
                visit(corner);
            }
        }
    }
}

/// Checks the link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999): the common neighbours of u and v are exactly the
/// tips of the triangles on the edge, and these tips are not joined to both of them by another pair of triangles.
bool Collapse::keeps_topology(std::uint32_t u, std::uint32_t v) {
    std::array<std::uint32_t, 2> tips{};
    std::size_t count = 0; // of tips
    for (const std::uint32_t t : triangles_of_[u]) {
        if (!has(t, v)) {
            continue;
        }
        for (const std::uint32_t corner : triangles_[t]) {
            if (corner != u && corner != v) {
                if (count == tips.size()) {
                    return false;
                }
                tips[count++] = corner;
            }
        }
    }
    if (count == 2 && vertices_[u].on_boundary && vertices_[v].on_boundary) {
        return false;
    }
    for_each_neighbour(u, [](std::uint32_t) {});
    const std::uint32_t around_u = walk_++;
    std::size_t shared = 0;
    for (const std::uint32_t t : triangles_of_[v]) {
        for (const std::uint32_t corner : triangles_[t]) {
            if (corner != v && vertices_[corner].mark == around_u) {
                vertices_[corner].mark = walk_; // counted only once
                ++shared;
            }
        }
    }
    if (shared != count) {
        return false;
    }
    const auto joins_tips = [&](std::uint32_t t) { return has(t, tips[0]) && has(t, tips[1]); };
    return count < 2 || (std::none_of(triangles_of_[u].begin(), triangles_of_[u].end(), joins_tips) ||
                         std::none_of(triangles_of_[v].begin(), triangles_of_[v].end(), joins_tips));
}

bool Collapse::stays_near(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    Quadric quadric = vertices_[u].quadric;
    quadric += vertices_[v].quadric;
    const double limit = limits_.plane_distance / scale_;
    return quadric.error(to) <= limit * limit * (vertices_[u].area + vertices_[v].area);
}

/// Returns whether no remaining triangle is inverted or becomes a needle.
bool Collapse::keeps_shape(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    for (const std::uint32_t vertex : {u, v}) {
        for (const std::uint32_t t : triangles_of_[vertex]) {
            if (has(t, u) && has(t, v)) {
                continue;
            }
            std::array<Vec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = vertices_[triangles_[t][k]].point;
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

/// Returns the change of the volume under the triangles at u and v when both move to `to`; exact for a closed mesh.
double Collapse::volume_gain(std::uint32_t u, std::uint32_t v, const Vec3& to) const {
    const auto six_volumes = [&](std::uint32_t t, bool moved) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = triangles_[t][k];
            p[k] = (moved && (corner == u || corner == v) ? to : vertices_[corner].point) - to;
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

bool Collapse::try_collapse(const Candidate& cheapest, Candidates& queue) {
    const std::uint32_t u = cheapest.u, v = cheapest.v;
    double cost = 0;
    const Vec3 to = placement(u, v, cost);
    if (!stays_near(u, v, to) || !keeps_topology(u, v) || !keeps_shape(u, v, to)) {
        return false;
    }
    const double gain = closed_ ? volume_gain(u, v, to) : 0;
    const double before = volumes_before_[vertices_[u].part];
    if (std::abs(volumes_[vertices_[u].part] + gain - before) > limits_.volume_change * std::abs(before)) {
        return false;
    }
    volumes_[vertices_[u].part] += gain;
    vertices_[u].point = to;
    vertices_[u].moved = 1;
    vertices_[u].on_boundary = vertices_[u].on_boundary || vertices_[v].on_boundary;
    vertices_[u].quadric += vertices_[v].quadric;
    vertices_[u].area += vertices_[v].area;
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
    ++vertices_[u].stamp;
    ++vertices_[v].stamp;
    for_each_neighbour(u, [&](std::uint32_t neighbour) { queue.push(candidate(u, neighbour)); });
    return true;
}

Mesh Collapse::run() {
    // A refused edge is tried again in a next pass, after its surroundings have changed.
    for (bool progress = true; progress && count_ > limits_.triangles;) {
        progress = false;
        Candidates queue(candidates());
        for (std::size_t step = 0; !queue.empty() && count_ > limits_.triangles; ++step) {
            if (step % 4096 == 0) {
                context_.check_cancelled();
            }
            const Candidate cheapest = queue.pop();
            progress |= !is_stale(cheapest) && try_collapse(cheapest, queue);
        }
    }
    return result();
}

Mesh Collapse::result() const {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    Mesh mesh;
    std::vector<std::uint32_t> number(vertices_.size(), unused);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
        if (!triangles_of_[i].empty()) {
            number[i] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(vertices_[i].moved ? vertices_[i].point * scale_ + center_ : original_.vertices[i]);
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

Quadric Quadric::plane(const Vec3& point, const Vec3& n, double weight) {
    const double d = -dot(n, point);
    Quadric q;
    q.xx_ = weight * n.x * n.x;
    q.xy_ = weight * n.x * n.y;
    q.xz_ = weight * n.x * n.z;
    q.yy_ = weight * n.y * n.y;
    q.yz_ = weight * n.y * n.z;
    q.zz_ = weight * n.z * n.z;
    q.b_ = n * (weight * d);
    q.c_ = weight * d * d;
    return q;
}

Vec3 Quadric::times(const Vec3& x) const {
    return {xx_ * x.x + xy_ * x.y + xz_ * x.z, xy_ * x.x + yy_ * x.y + yz_ * x.z, xz_ * x.x + yz_ * x.y + zz_ * x.z};
}

double Quadric::error(const Vec3& x) const {
    return std::max(0.0, dot(x, times(x)) + 2 * dot(b_, x) + c_);
}

Vec3 Quadric::minimizer(const Vec3& near) const {
    // (A + r I) s = -(A near + b) for the step s from `near`. The small r makes the matrix regular (Tikhonov):
    // directions that the planes do not determine get no step.
    const double r = 1e-4 * (xx_ + yy_ + zz_);
    if (!(r > 0)) {
        return near;
    }
    const Vec3 row0 = {xx_ + r, xy_, xz_}, row1 = {xy_, yy_ + r, yz_}, row2 = {xz_, yz_, zz_ + r};
    const Vec3 c0 = cross(row1, row2), c1 = cross(row2, row0), c2 = cross(row0, row1);
    const double determinant = dot(row0, c0);
    const Vec3 g = -(times(near) + b_);
    return near + (c0 * g.x + c1 * g.y + c2 * g.z) / determinant;
}

} // namespace foam::simplify
