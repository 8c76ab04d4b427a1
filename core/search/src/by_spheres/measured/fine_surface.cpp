#include "by_spheres/measured/surface.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/triangles.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::uint32_t unnamed = UINT32_MAX;

/// Returns the first point in each cell of a lattice.
Points one_a_cell(const Points& points, double cell) {
    const auto index = [&](float value) { return static_cast<std::uint64_t>((value + 2) / cell); };
    std::unordered_set<std::uint64_t> taken;
    Points some;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (taken.insert(index(points.x[i]) << 40 | index(points.y[i]) << 20 | index(points.z[i])).second) {
            some.add(points, i);
        }
    }
    return some;
}

} // namespace

FineSurface::FineSurface(const Mesh& surface, const Frame& frame, std::size_t pieces) {
    add_faces(surface, frame);
    for (const auto& [a, b, c] : faces) {
        area += norm(cross(points.at(b) - points.at(a), points.at(c) - points.at(a))) / 2;
    }
    // Triangles halved at their longest edges down to a length of h have an area of some h² / 5. A needle without area
    // is cut along its length.
    const auto number = static_cast<double>(pieces);
    double longest = std::max(std::sqrt(5 * area / number), 4 / number);
    // Needles could require any number of pieces. Then their edges stay longer: some more pieces are enough to begin
    // with, and power cells cut the long ones.
    const std::size_t more_than_others_take = std::max<std::size_t>(100'000, 4 * pieces);
    std::size_t most_faces = faces.size() + more_than_others_take;
    while (!halve_long_edges(longest, most_faces)) {
        faces.clear();
        own_edges.clear();
        points = {};
        add_faces(surface, frame);
        most_faces = faces.size() + 4 * pieces;
        longest *= 1.5;
        fine = false;
    }
    middles_end = points.size();
}

void FineSurface::add_faces(const Mesh& surface, const Frame& frame) {
    // A closed surface has half as many points as triangles; one with more repeats its corners for each triangle.
    const bool soup = surface.vertices.size() > surface.triangles.size();
    const std::vector<std::uint32_t> welded = soup ? geometry::welded_indices(surface) : std::vector<std::uint32_t>{};
    std::vector<std::uint32_t> name(surface.vertices.size(), unnamed);
    const auto point = [&](std::uint32_t vertex) {
        std::uint32_t& known = name[soup ? welded[vertex] : vertex];
        if (known == unnamed) {
            known = static_cast<std::uint32_t>(points.size());
            points.add(frame.to_unit(surface.vertices[vertex]));
        }
        return known;
    };
    faces.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        const std::uint32_t a = point(t[0]), b = point(t[1]), c = point(t[2]);
        faces.push_back({a, b, c});
    }
    own_edges.assign(faces.size(), 7);
    middles_begin = points.size();
}

bool FineSurface::halve_long_edges(double longest, std::size_t most_faces) {
    const auto most = static_cast<float>(longest * longest);
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto squared = [&](std::uint32_t a, std::uint32_t b) {
        const float dx = points.x[a] - points.x[b], dy = points.y[a] - points.y[b], dz = points.z[a] - points.z[b];
        return dx * dx + dy * dy + dz * dz;
    };
    CancellationCounter often(10'000);
    for (std::size_t f = 0; f < faces.size();) {
        often.check();
        auto [a, b, c] = faces[f];
        const float ab = squared(a, b), bc = squared(b, c), ca = squared(c, a), far = std::max({ab, bc, ca});
        if (!(far > most)) {
            ++f;
            continue;
        }
        if (faces.size() >= most_faces) {
            return false;
        }
        // Rotated so that the longest edge goes from a to b.
        const unsigned own = own_edges[f];
        unsigned of_ab = own & 1, of_bc = own >> 1 & 1, of_ca = own >> 2;
        if (ab != far) {
            std::tie(a, b, c) = bc == far ? std::tuple(b, c, a) : std::tuple(c, a, b);
            std::tie(of_ab, of_bc, of_ca) =
                bc == far ? std::tuple(of_bc, of_ca, of_ab) : std::tuple(of_ca, of_ab, of_bc);
        }
        const auto [low, high] = std::minmax(a, b);
        const auto [middle, fresh] =
            middles.try_emplace(std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(points.size()));
        if (fresh) {
            points.add((points.at(a) + points.at(b)) / 2);
        }
        faces[f] = {a, middle->second, c};
        own_edges[f] = static_cast<std::uint8_t>(of_ab | of_ca << 2);
        faces.push_back({middle->second, b, c});
        own_edges.push_back(static_cast<std::uint8_t>(of_ab | of_bc << 1));
    }
    return true;
}

FineSurface::FineSurface(Points seen)
    : points(std::move(seen)), middles_begin(points.size()), middles_end(points.size()) {
    constexpr double cell = 1.0 / 16;
    area = static_cast<double>(one_a_cell(points, cell).size()) * cell * cell;
}

Points FineSurface::sample(std::size_t count) const {
    return one_a_cell(points, std::max(std::sqrt(area / static_cast<double>(count)), 1e-3));
}

} // namespace foam::inline search::by_spheres
