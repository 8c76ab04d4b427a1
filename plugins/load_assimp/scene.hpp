// The conversion of assimp's scene to a Mesh. Nothing in the scene is trusted.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/context.hpp>

#include <assimp/IOSystem.hpp>
#include <assimp/matrix4x4.h>
#include <assimp/scene.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace foam::load_assimp {

/// The map p ↦ x p.x + y p.y + z p.z + shift.
struct Affine {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, shift{};

    Vec3 direction(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
    Vec3 operator()(const Vec3& p) const { return direction(p) + shift; }
    /// Returns the composition that applies `first` first.
    Affine operator*(const Affine& first) const {
        return {direction(first.x), direction(first.y), direction(first.z), (*this)(first.shift)};
    }
    bool mirrors() const { return dot(x, cross(y, z)) < 0; }

    static Affine scale(double s) { return {{s, 0, 0}, {0, s, 0}, {0, 0, s}, {}}; }
    static Affine from(const aiMatrix4x4& m) {
        return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
    }
};

/// Returns the map from the frame of the scene's root to the mesh. `ending`: of the file, lower case.
Affine frame_of(const aiScene& scene, std::string_view ending);

/// Returns a note on the unit of such files; empty: none.
std::string_view unit_note(std::string_view ending);

/// Returns the extensions of formats whose unit assimp reads, so that the mesh is in metres.
std::span<const std::string_view> endings_with_unit();

/// The remedy for files of more than max_bytes.
inline constexpr std::string_view too_large_remedy = "simplify the mesh, or raise max_bytes of load.assimp";

/// A read-only file system for assimp. Beside the mesh file only files in its folder or below can be opened. All
/// together have at most `max_bytes`.
class Files final : public Assimp::IOSystem {
public:
    /// Reads `file`. Throws Error(input).
    Files(const std::filesystem::path& file, std::uintmax_t max_bytes);

    /// Returns the name of the mesh for assimp.
    std::string mesh() const { return mesh_.string(); }

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Returns the requested files that could not be opened: "NAME: why".
    const std::vector<std::string>& refused() const { return refused_; }

private:
    /// Returns the path of a name that assimp requests; empty: outside of the folder.
    std::filesystem::path place_of(const char* file) const;

    std::filesystem::path mesh_, folder_;
    std::uintmax_t bytes_left_;
    std::map<std::filesystem::path, std::string> contents_;
    std::vector<std::string> refused_;
};

/// The error in a scene, and the remedy; without the file's name.
class BadScene : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Returns whether there are polygons to cut into triangles. Throws BadScene unless all faces refer to existing
/// vertices and give at most `max_triangles`. Must run before any other step of assimp reads the faces.
bool check_faces(const aiScene& scene, std::size_t max_triangles);

/// Returns the triangles of all nodes, placed by `frame` and their nodes; equal vertices become one. Leaves out
/// triangles with two equal corners, lines and points, with a note. Throws BadScene.
Mesh mesh_of(const aiScene& scene, const Affine& frame, std::size_t max_triangles, Context& context);

} // namespace foam::load_assimp
