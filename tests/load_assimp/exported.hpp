// Meshes as files of assimp's own exporters.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <assimp/scene.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace foam::test {

/// A format that assimp writes, and reads as a mesh.
struct Format {
    const char* id; ///< of the exporter
    const char* ending;
    double metres = 1; ///< what load.assimp makes of 1 in the file
};

inline void PrintTo(const Format& format, std::ostream* out) {
    *out << format.id;
}

/// fbx is binary, fbxa text.
inline constexpr Format formats[] = {
    {"3ds", "3ds"},        {"x", "x"},           {"x3d", "x3d"},       {"3mf", "3mf"},
    {"fbxa", "fbx", 0.01}, {"fbx", "fbx", 0.01}, {"assbin", "assbin"}, {"collada", "dae"},
    {"obj", "obj"},        {"stlb", "stl"},      {"ply", "ply"},       {"glb2", "glb"}};

std::unique_ptr<aiMesh> part_of(const Mesh& mesh);
/// A scene with a root node above `nodes`.
std::unique_ptr<aiScene> scene_of(std::vector<std::unique_ptr<aiMesh>> parts, std::vector<aiNode*> nodes);
/// A node that shows the parts.
aiNode* node_of(std::vector<unsigned> parts, const aiMatrix4x4& place = {});
/// A mesh in a node of its own.
std::unique_ptr<aiScene> scene_of(const Mesh& mesh);

/// Writes a file. What cannot be written fails the test.
void export_scene(const aiScene& scene, const std::string& format, const std::filesystem::path& file);

} // namespace foam::test
