// A mesh with the quantities that comparisons need.
#pragma once

#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/mesh_change.hpp>

#include <optional>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Computes each quantity once, on first use: in a chain of filters every mesh is compared twice, with its predecessor
/// and with its successor. Only distance() may be called by several threads at once.
class ComparedMesh {
public:
    /// `mesh` must outlive this. Precondition: as for mesh_change().
    explicit ComparedMesh(const Mesh& mesh) : mesh_(mesh) {}

    const Mesh& mesh() const { return mesh_; }
    const Mesh& welded();
    /// Returns the defects of the mesh as it is indexed if that is sound (bodies that touch may have vertices at one
    /// place), else of the mesh with equal vertices welded (raw files give every triangle its own vertices).
    const Topology& defects();
    /// Returns the signed volume; absent unless closed and oriented.
    std::optional<double> volume();
    /// Builds the hierarchy. Call it before the first call of distance().
    void prepare_distances();
    /// Returns the distance from the point to the surface.
    double distance(const Vec3& point) const;

private:
    const Mesh& mesh_;
    std::optional<Mesh> welded_;
    std::optional<Topology> defects_;
    std::optional<Bvh> bvh_;
};

/// See foam::mesh_change().
MeshChange mesh_change(ComparedMesh& before, ComparedMesh& after, std::uint64_t seed, std::size_t points = 500);

} // namespace geometry
} // namespace foam
