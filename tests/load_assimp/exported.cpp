#include "exported.hpp"

#include <assimp/Exporter.hpp>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

namespace foam::test {
namespace {

template <class T> T** moved(std::vector<std::unique_ptr<T>>& items) {
    T** array = new T*[items.size()];
    for (std::size_t i = 0; i < items.size(); ++i) {
        array[i] = items[i].release();
    }
    return array;
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

constexpr std::size_t fbx_header = 27, fbx_record = 25;

/// Appends the nodes in [at, end) of a binary FBX file of version 7500, each with the empty record behind its children.
void append_nodes(const std::string& bytes, std::size_t at, std::size_t end, std::string& out) {
    while (at + fbx_record <= end) {
        const std::uint64_t next = number_at(bytes, at), properties = number_at(bytes, at + 16);
        if (next <= at || next > end) {
            return; // the footer
        }
        const std::size_t begin = out.size();
        const std::size_t own = fbx_record + static_cast<unsigned char>(bytes[at + 24]) + properties;
        out.append(bytes, at, own);
        if (at + own < next) {
            append_nodes(bytes, at + own, next, out);
            out.append(fbx_record, '\0');
        }
        const std::uint64_t written = out.size();
        std::memcpy(out.data() + begin, &written, sizeof written);
        at = next;
    }
}

/// assimp 5.2 forgets the empty records that end lists of nodes in binary FBX files, and cannot read what it wrote.
void complete_fbx(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    std::string out = bytes.substr(0, fbx_header);
    append_nodes(bytes, fbx_header, bytes.size(), out);
    out.append(fbx_record, '\0');
    std::ofstream(file, std::ios::binary) << out;
}

} // namespace

std::unique_ptr<aiMesh> part_of(const Mesh& mesh) {
    auto part = std::make_unique<aiMesh>();
    part->mName = "part";
    part->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    part->mNumVertices = static_cast<unsigned>(mesh.vertices.size());
    part->mVertices = new aiVector3D[mesh.vertices.size()];
    part->mNormals = new aiVector3D[mesh.vertices.size()];
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& v = mesh.vertices[i];
        part->mVertices[i] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        part->mNormals[i] = {0, 0, 1};
    }
    part->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
    part->mFaces = new aiFace[mesh.triangles.size()];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        part->mFaces[t].mNumIndices = 3;
        part->mFaces[t].mIndices = new unsigned[3];
        std::copy(mesh.triangles[t].begin(), mesh.triangles[t].end(), part->mFaces[t].mIndices);
    }
    return part;
}

aiNode* node_of(std::vector<unsigned> parts, const aiMatrix4x4& place) {
    auto* node = new aiNode("node");
    node->mTransformation = place;
    node->mNumMeshes = static_cast<unsigned>(parts.size());
    node->mMeshes = parts.empty() ? nullptr : new unsigned[parts.size()];
    std::copy(parts.begin(), parts.end(), node->mMeshes);
    return node;
}

std::unique_ptr<aiScene> scene_of(std::vector<std::unique_ptr<aiMesh>> parts, std::vector<aiNode*> nodes) {
    auto scene = std::make_unique<aiScene>();
    scene->mNumMaterials = 1;
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    scene->mNumMeshes = static_cast<unsigned>(parts.size());
    scene->mMeshes = moved(parts);
    scene->mRootNode = new aiNode("root");
    scene->mRootNode->addChildren(static_cast<unsigned>(nodes.size()), nodes.data());
    return scene;
}

std::unique_ptr<aiScene> scene_of(const Mesh& mesh) {
    std::vector<std::unique_ptr<aiMesh>> parts;
    parts.push_back(part_of(mesh));
    return scene_of(std::move(parts), {node_of({0})});
}

void export_scene(const aiScene& scene, const std::string& format, const std::filesystem::path& file) {
    Assimp::Exporter exporter;
    ASSERT_EQ(exporter.Export(&scene, format.c_str(), file.string()), aiReturn_SUCCESS)
        << format << ": " << exporter.GetErrorString();
    if (format == "fbx") {
        complete_fbx(file);
    }
}

} // namespace foam::test
