#include "by_spheres/measured/occupancy.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {
namespace {

struct Flat {
    double u, v, along;
};

/// The side of the edge a–b on which a place lies, and twice the area of their triangle. The edge is taken from its
/// smaller end, so that both triangles at the edge see a place on it on the same side.
struct Side {
    bool left;
    double area;

    Side(const Flat& a, const Flat& b, double u, double v) {
        const bool in_order = a.u < b.u || (a.u == b.u && a.v < b.v);
        const Flat &from = in_order ? a : b, &to = in_order ? b : a;
        const double turn = (to.u - from.u) * (v - from.v) - (to.v - from.v) * (u - from.u);
        left = (turn >= 0) == in_order;
        area = std::abs(turn);
    }
};

struct Crossing {
    std::uint32_t line;
    int change;
    double at;
};

void draw(const Flat& a, const Flat& b, const Flat& c, const LineLattice& lattice, std::vector<Crossing>& crossings) {
    const double area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    if (area == 0) {
        return;
    }
    const bool left = area > 0;
    const auto range = [&](double low, double high, int k) {
        const double from = std::ceil((low - lattice.low[k]) / lattice.step);
        const double to = std::floor((high - lattice.low[k]) / lattice.step);
        return std::pair{static_cast<int>(std::max(from, 0.0)),
                         static_cast<int>(std::min(to, static_cast<double>(lattice.count[k] - 1)))};
    };
    const auto [u0, u1] = range(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}), 0);
    const auto [v0, v1] = range(std::min({a.v, b.v, c.v}), std::max({a.v, b.v, c.v}), 1);
    for (int j = v0; j <= v1; ++j) {
        const double v = lattice.low[1] + lattice.step * j;
        for (int i = u0; i <= u1; ++i) {
            const double u = lattice.low[0] + lattice.step * i;
            const Side bc(b, c, u, v), ca(c, a, u, v), ab(a, b, u, v);
            if (ab.left != left || bc.left != left || ca.left != left) {
                continue;
            }
            const double sum = bc.area + ca.area + ab.area;
            const double at = sum > 0 ? (bc.area * a.along + ca.area * b.along + ab.area * c.along) / sum : a.along;
            // Outward normals have a positive component along the axis where the line leaves.
            crossings.push_back({static_cast<std::uint32_t>(j * lattice.count[0] + i), left ? -1 : 1, at});
        }
    }
}

} // namespace

LinePieces pieces_along(const Mesh& surface, const Frame& frame, const LineLattice& lattice) {
    const int u = (lattice.axis + 1) % 3, v = (lattice.axis + 2) % 3;
    std::vector<Flat> flat;
    flat.reserve(surface.vertices.size());
    for (const Vec3& vertex : surface.vertices) {
        const Vec3 p = frame.to_unit(vertex);
        flat.push_back({p[u], p[v], p[lattice.axis]});
    }
    std::vector<Crossing> crossings;
    for (const auto& [a, b, c] : surface.triangles) {
        draw(flat[a], flat[b], flat[c], lattice, crossings);
    }
    // Entering sorts before leaving at the same place: doubled sheets leave nothing between them.
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.line != b.line ? a.line < b.line : a.at != b.at ? a.at < b.at : a.change > b.change;
    });
    const std::size_t lines = static_cast<std::size_t>(lattice.count[0]) * static_cast<std::size_t>(lattice.count[1]);
    LinePieces result;
    result.first.reserve(lines + 1);
    result.sound.assign(lines, 1);
    std::size_t k = 0;
    for (std::size_t line = 0; line < lines; ++line) {
        result.first.push_back(result.pieces.size());
        int winding = 0;
        double enter = 0;
        for (; k < crossings.size() && crossings[k].line == line; ++k) {
            const int before = winding;
            winding += crossings[k].change;
            if (before <= 0 && winding > 0) {
                enter = crossings[k].at;
            } else if (before > 0 && winding <= 0) {
                result.pieces.push_back({enter, crossings[k].at});
            }
        }
        result.sound[line] = winding == 0;
    }
    result.first.push_back(result.pieces.size());
    return result;
}

} // namespace foam::search::by_spheres
