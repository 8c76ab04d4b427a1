#include "meshes.hpp"

#include <fmt/format.h>

#include <cstring>

namespace foam::mjcf {
namespace {

constexpr std::uintmax_t most_msh_bytes = 1'000'000'000;

/// Reads numbers of four bytes, as the processor has them: MuJoCo does likewise.
template <class T> T number_at(const std::string& bytes, std::size_t at) {
    static_assert(sizeof(T) == 4);
    T value{};
    std::memcpy(&value, bytes.data() + 4 * at, sizeof(T));
    return value;
}

[[noreturn]] void fail_msh(const std::filesystem::path& file, const char* what) {
    throw Error(ErrorCode::input,
                fmt::format("{}: it is no MSH file of MuJoCo: {}; remedy: STL or OBJ", file.string(), what));
}

} // namespace

Mesh read_msh(const std::filesystem::path& file) {
    const std::string bytes = bytes_of(file, most_msh_bytes, "simplify the mesh");
    if (bytes.size() < 16) {
        fail_msh(file, "it has no header");
    }
    std::size_t counts[4]; // vertices, normals, texture coordinates, triangles
    for (std::size_t i = 0; i < 4; ++i) {
        const auto count = number_at<std::int32_t>(bytes, i);
        if (count < 0) {
            fail_msh(file, "a count is negative");
        }
        counts[i] = static_cast<std::size_t>(count);
    }
    const std::size_t corners = 4, faces = corners + 3 * (counts[0] + counts[1]) + 2 * counts[2];
    if (counts[0] < 4 || bytes.size() != 4 * (faces + 3 * counts[3])) {
        fail_msh(file, "its size is not that of its header");
    }
    Mesh mesh;
    for (std::size_t i = 0; i < counts[0]; ++i) {
        const std::size_t at = corners + 3 * i;
        mesh.vertices.push_back(
            {number_at<float>(bytes, at), number_at<float>(bytes, at + 1), number_at<float>(bytes, at + 2)});
        if (!is_finite(mesh.vertices.back())) {
            fail_msh(file, "a vertex is not finite");
        }
    }
    for (std::size_t i = 0; i < counts[3]; ++i) {
        Triangle& triangle = mesh.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = number_at<std::uint32_t>(bytes, faces + 3 * i + k);
            if (triangle[k] >= counts[0]) {
                fail_msh(file, "a triangle has a corner that is no vertex");
            }
        }
    }
    return mesh;
}

} // namespace foam::mjcf
