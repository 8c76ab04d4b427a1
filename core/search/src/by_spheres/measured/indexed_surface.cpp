#include "by_spheres/measured/surface.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace foam::inline search::by_spheres {
namespace {

Ball bounds_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = (a + b + c) / 3;
    const double squared = std::max({squared_norm(a - middle), squared_norm(b - middle), squared_norm(c - middle)});
    return ball_of({middle, std::sqrt(squared)});
}

} // namespace

IndexedSurface::IndexedSurface(const Mesh& surface, const Frame& frame) {
    add_faces(surface, frame);
    add_edges();
}

IndexedSurface::IndexedSurface(const Mesh& surface, const Frame& frame, std::size_t most, int resolution) {
    add_faces(surface, frame);
    if (points.size() > most) {
        if (IndexedSurface less = clustered(resolution); !less.faces.empty()) {
            *this = std::move(less);
        }
    }
    add_edges();
}

void IndexedSurface::add_faces(const Mesh& surface, const Frame& frame) {
    const std::vector<std::uint32_t> name = name_places(surface, frame);
    faces.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        faces.push_back({{name[t[0]], name[t[1]], name[t[2]]}, {}, {}});
    }
}

void IndexedSurface::add_edges() {
    struct Side {
        std::uint32_t from, to, face;
        std::size_t k;
    };
    std::vector<Side> sides;
    sides.reserve(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Face& face = faces[f];
        face.bounds = bounds_of(points.at(face.corners[0]), points.at(face.corners[1]), points.at(face.corners[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [from, to] = std::minmax(face.corners[k], face.corners[(k + 1) % 3]);
            sides.push_back({from, to, static_cast<std::uint32_t>(f), k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.from, a.to, a.face, a.k) < std::tie(b.from, b.to, b.face, b.k);
    });
    for (const Side& side : sides) {
        if (edges.empty() || edges.back() != Line{side.from, side.to}) {
            edges.push_back({side.from, side.to});
        }
        faces[side.face].edges[side.k] = static_cast<std::uint32_t>(edges.size() - 1);
    }
}

std::vector<std::uint32_t> IndexedSurface::name_places(const Mesh& surface, const Frame& frame) {
    std::vector<char> used(surface.vertices.size(), 0);
    for (const Triangle& t : surface.triangles) {
        used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < used.size(); ++i) {
        if (used[i]) {
            order.push_back(i);
        }
    }
    const auto before = [&](std::uint32_t i, std::uint32_t k) {
        const Vec3 &a = surface.vertices[i], &b = surface.vertices[k];
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::sort(order.begin(), order.end(), before);
    std::vector<std::uint32_t> name(surface.vertices.size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || before(order[k - 1], order[k])) {
            points.add(frame.to_unit(surface.vertices[order[k]]));
        }
        name[order[k]] = static_cast<std::uint32_t>(points.size() - 1);
    }
    return name;
}

IndexedSurface IndexedSurface::coarse(int resolution) const {
    IndexedSurface result = clustered(resolution);
    if (result.faces.empty()) {
        return *this;
    }
    result.add_edges();
    return result;
}

IndexedSurface IndexedSurface::clustered(int resolution) const {
    Box bounds;
    for (std::size_t i = 0; i < points.size(); ++i) {
        bounds.add(points.at(i));
    }
    const Vec3 size = bounds.size();
    const double cell = std::max({size.x, size.y, size.z, 1e-6}) / resolution;
    const auto cells = static_cast<std::uint64_t>(resolution) + 1;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Vec3 at = (points.at(i) - bounds.low) / cell;
        order.emplace_back((static_cast<std::uint64_t>(at.z) * cells + static_cast<std::uint64_t>(at.y)) * cells +
                               static_cast<std::uint64_t>(at.x),
                           i);
    }
    std::sort(order.begin(), order.end());
    IndexedSurface result;
    result.is_coarse = true;
    std::vector<std::uint32_t> name(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || order[k].first != order[k - 1].first) {
            result.points.add(points, order[k].second);
        }
        name[order[k].second] = static_cast<std::uint32_t>(result.points.size() - 1);
    }
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (const Face& face : faces) {
        std::array<std::uint32_t, 3> c{name[face.corners[0]], name[face.corners[1]], name[face.corners[2]]};
        std::sort(c.begin(), c.end());
        corners.push_back(c);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const auto& c : corners) {
        // A face collapsed to an edge is usually part of others; one collapsed to a point always is.
        if (c[0] != c[1] && c[1] != c[2]) {
            result.faces.push_back({c, {}, {}});
        }
    }
    return result;
}

} // namespace foam::inline search::by_spheres
