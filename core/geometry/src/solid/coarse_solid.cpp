#include <foam/geometry/internal/solids.hpp>

#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline geometry {
namespace {

/// About the number of triangles of a coarse solid.
constexpr double wanted_triangles = 20'000;
/// Share of the extent below which cells do not shrink: a crumpled surface keeps more triangles.
constexpr double least_cell = 1.0 / 4096;
/// A coarse solid with a larger share of the triangles would not be worth its making.
constexpr double most_left = 0.5;

/// Cells by their keys, numbered as they come: open addressing, at most half full.
class NumberedCells {
public:
    std::uint32_t number(std::uint64_t key) {
        if (2 * keys_.size() >= table_.size()) {
            grow();
        }
        std::uint32_t& entry = table_[slot(key)];
        if (entry == none) {
            entry = static_cast<std::uint32_t>(keys_.size());
            keys_.push_back(key);
        }
        return entry;
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::size_t slot(std::uint64_t key) const {
        const std::size_t mask = table_.size() - 1;
        std::size_t at = key * 0x9E3779B97F4A7C15u >> 32 & mask;
        while (table_[at] != none && keys_[table_[at]] != key) {
            at = (at + 1) & mask;
        }
        return at;
    }
    void grow() {
        table_.assign(2 * table_.size(), none);
        for (std::uint32_t i = 0; i < keys_.size(); ++i) {
            table_[slot(keys_[i])] = i;
        }
    }

    std::vector<std::uint64_t> keys_;
    std::vector<std::uint32_t> table_ = std::vector<std::uint32_t>(1024, none);
};

/// A lattice over a box.
struct VertexLattice {
    Vec3 low;
    double cell;

    VertexLattice(const Box& box, double area) : low(box.low) {
        const Vec3 size = box.size();
        const double extent = std::max({size.x, size.y, size.z});
        // A surface of area A meets about 1.5 A / cell² cells, each of which becomes a vertex of two triangles.
        cell = std::max(std::sqrt(3 * area / wanted_triangles), least_cell * extent);
    }
    /// Returns the key of the cell that contains a point, and the squared distance from its middle, in cells.
    std::pair<std::uint64_t, float> place(const Vec3& p) const {
        const Vec3 at = (p - low) / cell;
        const Vec3 corner{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
        const Vec3 aside = at - corner - Vec3{0.5, 0.5, 0.5};
        const auto index = [](double value) { return static_cast<std::uint64_t>(std::max(value, 0.0)); };
        return {index(corner.x) << 40 | index(corner.y) << 20 | index(corner.z),
                static_cast<float>(squared_norm(aside))};
    }
};

/// Returns the mesh with one vertex for each cell of the lattice.
Mesh clustered(const Mesh& mesh, const VertexLattice& lattice) {
    NumberedCells cells;
    std::vector<std::uint32_t> name(mesh.vertices.size());
    std::vector<float> nearest; // squared distance of the vertex that represents a cell from its middle
    Mesh result;
    CancellationCounter asking(4096);
    for (std::uint32_t i = 0; i < name.size(); ++i) {
        asking.check();
        const auto [key, aside] = lattice.place(mesh.vertices[i]);
        name[i] = cells.number(key);
        if (name[i] == result.vertices.size()) {
            result.vertices.push_back(mesh.vertices[i]);
            nearest.push_back(aside);
        } else if (aside < nearest[name[i]]) {
            result.vertices[name[i]] = mesh.vertices[i];
            nearest[name[i]] = aside;
        }
    }
    for (const Triangle& t : mesh.triangles) {
        const std::uint32_t a = name[t[0]], b = name[t[1]], c = name[t[2]];
        if (a != b && b != c && c != a) {
            result.triangles.push_back({a, b, c});
        }
    }
    return result;
}

std::shared_ptr<const Solid> made_coarse(const Solid& solid) {
    if (solid.surface().triangles.size() <= many_triangles) {
        return nullptr;
    }
    const VertexLattice lattice(solid.bounds(), solid.area());
    std::vector<Solid::Part> parts = solid.parts();
    std::size_t left = 0;
    for (Solid::Part& part : parts) {
        if (!part.primitive) {
            part.mesh = std::make_shared<const Mesh>(clustered(*part.mesh, lattice));
            left += part.mesh->triangles.size();
        }
    }
    if (left == 0 || static_cast<double>(left) > most_left * static_cast<double>(solid.surface().triangles.size())) {
        return nullptr;
    }
    return Solid::make(std::move(parts));
}

} // namespace

std::shared_ptr<const Solid> coarse_solid(const Solid& solid) {
    const SolidData& data = SolidAccess::data(solid);
    std::call_once(data.coarse_once, [&] { data.coarse = made_coarse(solid); });
    return data.coarse;
}

} // namespace foam::inline geometry
