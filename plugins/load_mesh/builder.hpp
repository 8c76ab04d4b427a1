// Collects faces into a mesh.
#pragma once

#include "text.hpp"

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace foam::load_mesh {

/// What to do with a file of more than Limits::max_bytes.
inline constexpr std::string_view too_large_remedy = "simplify the mesh, or raise max_bytes of load.mesh";

struct Limits {
    std::size_t max_triangles;
    std::uintmax_t max_bytes;               ///< of a file
    std::size_t polygon_work = 300'000'000; ///< corners looked at to cut all polygons into triangles; a second or two
};

/// Vertices with identical coordinates get one index (-0 counts as 0); every triangle is kept. O(1) a call, expected.
class MeshBuilder {
public:
    MeshBuilder(const Source& source, const Limits& limits, Context& context);

    /// Precondition: finite.
    std::uint32_t vertex(const Vec3& point);
    /// Throws when there are too many, or when the user cancels.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// Throws if so many triangles in all are too many.
    void expect_triangles(std::uint64_t count) const;
    /// A plane polygon of at least three corners, convex or not.
    void polygon(std::span<const std::uint32_t> corners);

    const Limits& limits() const { return limits_; }
    const Mesh& mesh() const { return mesh_; }
    /// The mesh, vertices in the order of their first use. The builder is then empty.
    Mesh take();

private:
    std::size_t slot(const Vec3& point) const;
    void grow();

    const Source& source_;
    Limits limits_;
    Context& context_;
    std::size_t polygon_work_; ///< what is left of it
    Mesh mesh_;
    std::vector<std::uint32_t> table_; ///< open addressing: index + 1 of a vertex, or 0
};

/// The vertices of a file as it numbers them. One that is not finite is an error only where a face uses it.
class FileVertices {
public:
    explicit FileVertices(MeshBuilder& builder) : builder_(builder) {}

    /// `error()`: the error for a point that is not finite.
    template <class MakeError> void add(const Vec3& point, MakeError error) {
        if (!is_finite(point)) {
            errors_.try_emplace(indices_.size(), error());
        }
        indices_.push_back(is_finite(point) ? builder_.vertex(point) : none);
    }
    void reserve(std::size_t count) { indices_.reserve(count); }
    std::size_t size() const { return indices_.size(); }
    /// The builder's index of it.
    std::uint32_t operator[](std::size_t i) const {
        if (indices_[i] == none) {
            throw errors_.at(i);
        }
        return indices_[i];
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
    MeshBuilder& builder_;
    std::vector<std::uint32_t> indices_;
    std::map<std::size_t, Error> errors_;
};

/// Triangles of a plane polygon in 3-space by ear clipping (Meisters 1975); convex polygons become the fan of corner 0.
/// Always corners - 2 triangles: a polygon that crosses itself gives some. `work`: corners that may be looked at; what
/// is spent is taken off. Empty if that is not enough. O(n) if it is convex, at worst O(n^2) for n corners, more if
/// tangled.
std::vector<Triangle> triangulated(std::span<const Vec3> corners, std::size_t& work);

} // namespace foam::load_mesh
