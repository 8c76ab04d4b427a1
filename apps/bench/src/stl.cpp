#include "stl.hpp"

#include <foam/runtime/internal/bytes.hpp>

namespace foam::inline bench::experiment {

std::string to_binary_stl(const Mesh& mesh) {
    constexpr std::size_t header = 80, record = 50;
    std::string bytes("binary STL");
    bytes.resize(header, ' ');
    bytes.reserve(header + 4 + record * mesh.triangles.size());
    put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Triangle& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            put(bytes, 0.0F); // the normal; readers take the winding
        }
        for (const std::uint32_t corner : triangle) {
            for (int axis = 0; axis < 3; ++axis) {
                put(bytes, static_cast<float>(mesh.vertices[corner][axis]));
            }
        }
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

} // namespace foam::bench::experiment
