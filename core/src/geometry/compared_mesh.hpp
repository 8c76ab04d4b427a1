// A mesh with what comparisons ask of it.
#pragma once

#include "geometry/bvh.hpp"

#include <foam/mesh_change.hpp>

#include <optional>

namespace foam::geometry {

/// Computes each thing once, when it is first asked for: in a chain of filters every mesh is compared twice, with what
/// came before it and with what came after. Not for several threads at once, but for distance().
class ComparedMesh {
public:
    /// `mesh` outlives this. Precondition: as of mesh_change().
    explicit ComparedMesh(const Mesh& mesh) : mesh_(mesh) {}

    const Mesh& mesh() const { return mesh_; }
    const Mesh& welded();
    /// Of the mesh as it is indexed if that is sound (bodies that touch may have vertices at one place), else after
    /// welding equal vertices (raw files give every triangle vertices of its own).
    const Topology& defects();
    /// Signed; absent unless closed and oriented.
    std::optional<double> volume();
    /// Before the first call of distance().
    void prepare_distances();
    /// From the point to the surface.
    double distance(const Vec3& point) const;

private:
    const Mesh& mesh_;
    std::optional<Mesh> welded_;
    std::optional<Topology> defects_;
    std::optional<Bvh> bvh_;
};

/// See foam::mesh_change().
MeshChange mesh_change(ComparedMesh& before, ComparedMesh& after, std::uint64_t seed, std::size_t points = 500);

} // namespace foam::geometry
