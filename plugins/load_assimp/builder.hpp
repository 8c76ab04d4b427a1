// Collects faces into a mesh.
#pragma once

#include "text.hpp"

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <span>
#include <string>
#include <vector>

namespace foam::load_assimp {

/// Vertices with identical coordinates get one index (-0 counts as 0); every triangle is kept. O(1) a call, expected.
class MeshBuilder {
public:
    MeshBuilder(const Source& source, std::size_t max_triangles, Context& context);

    /// Precondition: finite.
    std::uint32_t vertex(const Vec3& point);
    /// Throws when there are too many, or when the user cancels.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// A plane polygon of at least three corners, convex or not.
    void polygon(std::span<const std::uint32_t> corners);

    std::size_t max_triangles() const { return max_triangles_; }
    const Mesh& mesh() const { return mesh_; }
    /// The mesh, vertices in the order of their first use. The builder is then empty.
    Mesh take();

private:
    std::size_t slot(const Vec3& point) const;
    void grow();

    const Source& source_;
    std::size_t max_triangles_;
    Context& context_;
    Mesh mesh_;
    std::vector<std::uint32_t> table_; ///< open addressing: index + 1 of a vertex, or 0
};

/// Triangles of a plane polygon in 3-space by ear clipping (Meisters 1975); convex polygons become the fan of corner 0.
/// Always corners - 2 triangles: a polygon that crosses itself gives some. Empty if it is too tangled to be done in
/// reasonable time.
std::vector<Triangle> triangulated(std::span<const Vec3> corners);

} // namespace foam::load_assimp
