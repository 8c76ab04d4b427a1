// A mesh in two colours.
#pragma once

#include <foam/view/subject.hpp>

namespace foam::test {

/// A square of n x n x 2 triangles in the plane z = 0, the left half in one colour and the right in another.
inline ViewedMesh chequered(std::uint32_t n) {
    Mesh mesh;
    ViewedMesh result;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) {
            mesh.vertices.push_back({x / double(n), y / double(n), 0});
        }
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.triangles.push_back({a, a + 1, b});
            mesh.triangles.push_back({a + 1, b + 1, b});
            result.colours.insert(result.colours.end(), 2, 2 * x < n ? 0xFF0000FFu : 0x0000FFFFu);
        }
    }
    result.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return result;
}

} // namespace foam::test
