// Just enough of OFF, OBJ and binary STL to read the shared meshes.
#pragma once

#include "support/shared_folder.hpp"

#include <foam/geometry/mesh.hpp>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace foam::test {

inline std::filesystem::path shared_meshes() {
    return shared_folder() / "meshes";
}

inline Mesh read_stl(const std::string& bytes) {
    Mesh mesh;
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            float xyz[3];
            std::memcpy(xyz, bytes.data() + 84 + 50 * i + 12 + 12 * k, 12);
            mesh.vertices.push_back({xyz[0], xyz[1], xyz[2]});
        }
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

inline void add_polygon(Mesh& mesh, const std::vector<std::uint32_t>& corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
}

inline Mesh read_obj(std::istream& in) {
    Mesh mesh;
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        words >> word;
        if (line.starts_with("v ")) {
            Vec3 v;
            words >> v.x >> v.y >> v.z;
            mesh.vertices.push_back(v);
        } else if (line.starts_with("f ")) {
            std::vector<std::uint32_t> corners;
            while (words >> word) {
                corners.push_back(static_cast<std::uint32_t>(std::atoi(word.c_str()) - 1));
            }
            add_polygon(mesh, corners);
        }
    }
    return mesh;
}

inline Mesh read_off(std::istream& in) {
    std::string magic;
    std::size_t vertices = 0, faces = 0, edges = 0;
    in >> magic >> vertices >> faces >> edges;
    Mesh mesh;
    mesh.vertices.resize(vertices);
    for (Vec3& v : mesh.vertices) {
        in >> v.x >> v.y >> v.z;
    }
    for (std::size_t i = 0; i < faces; ++i) {
        std::size_t count = 0;
        in >> count;
        std::vector<std::uint32_t> corners(count);
        for (std::uint32_t& c : corners) {
            in >> c;
        }
        add_polygon(mesh, corners);
    }
    return mesh;
}

inline Mesh read_mesh(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (file.extension() == ".obj") {
        return read_obj(in);
    }
    if (file.extension() == ".off") {
        return read_off(in);
    }
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return read_stl(bytes.str());
}

} // namespace foam::test
