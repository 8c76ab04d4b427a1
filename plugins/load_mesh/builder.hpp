// Builds a mesh from faces.
#pragma once

#include "text.hpp"

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace foam::load_mesh {

/// The remedy for a file of more than Limits::max_bytes.
inline constexpr std::string_view too_large_remedy = "simplify the mesh, or raise max_bytes of load.mesh";

struct Limits {
    std::size_t max_triangles;
    std::uintmax_t max_bytes;               ///< of a file
    std::size_t polygon_work = 300'000'000; ///< corner visits for cutting all polygons into triangles; a second or two
};

/// Builds a mesh. Vertices with identical coordinates get one index (-0 counts as 0); every triangle is kept. Expected
/// O(1) per call.
class MeshBuilder {
public:
    MeshBuilder(const Source& source, const Limits& limits, Context& context);

    /// Returns the index of a vertex. Precondition: finite.
    std::uint32_t vertex(const Vec3& point);
    /// Adds a triangle. Throws if there are too many, or when the user cancels.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    /// Throws if that many triangles in all are too many.
    void expect_triangles(std::uint64_t count) const;
    /// Makes room for that many triangles of a surface, which usually has half as many vertices. Precondition: the file
    /// is long enough for them.
    void reserve_triangles(std::size_t count);
    /// Sets the colour of the triangles that follow, 0xRRGGBBAA; 0: none.
    void paint(std::uint32_t colour) { colour_ = colour; }
    /// Colours by the names of materials, for readers whose files have them elsewhere.
    void name_colours(std::map<std::string, std::uint32_t, std::less<>> colours) { named_ = std::move(colours); }
    /// Returns the colour of a material; 0 if it is not known.
    std::uint32_t colour_named(std::string_view material) const {
        const auto known = named_.find(material);
        return known == named_.end() ? 0 : known->second;
    }
    /// Returns the colour of each triangle so far; empty if none has one.
    const std::vector<std::uint32_t>& colours() const { return colours_; }
    /// Adds a plane polygon of at least three corners, convex or not.
    void polygon(std::span<const std::uint32_t> corners);

    const Limits& limits() const { return limits_; }
    const Mesh& mesh() const { return mesh_; }
    /// Returns the mesh with vertices in the order of their first use. The builder is then empty.
    Mesh take();

private:
    std::size_t slot(const Vec3& point) const;
    void grow();

    const Source& source_;
    Limits limits_;
    Context& context_;
    std::size_t polygon_work_; ///< the remaining part of it
    Mesh mesh_;
    std::uint32_t colour_ = 0; ///< of the triangles that follow
    std::map<std::string, std::uint32_t, std::less<>> named_;
    std::vector<std::uint32_t> colours_; ///< of the triangles; as far as the last one with a colour
    std::vector<std::uint32_t> table_;   ///< open addressing: index + 1 of a vertex, or 0
};

/// The vertices of a file by its numbers. A vertex that is not finite is an error only if a face uses it.
class FileVertices {
public:
    explicit FileVertices(MeshBuilder& builder) : builder_(builder) {}

    /// Adds a point. `error()`: the error if it is not finite.
    template <class MakeError> void add(const Vec3& point, MakeError error) {
        if (!is_finite(point)) {
            errors_.try_emplace(indices_.size(), error());
        }
        indices_.push_back(is_finite(point) ? builder_.vertex(point) : none);
    }
    void reserve(std::size_t count) { indices_.reserve(count); }
    std::size_t size() const { return indices_.size(); }
    /// Returns the builder's index of vertex i.
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

} // namespace foam::load_mesh
