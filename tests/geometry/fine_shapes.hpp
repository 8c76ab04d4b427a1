// Meshes of more than 100,000 triangles, from which on they are shared instead of copied.
#pragma once

#include "geometry/shapes.hpp"

#include <gtest/gtest.h>

namespace foam::test {

/// The unit sphere.
inline Mesh fine_ball() {
    Mesh mesh = ball({}, 1, 230);
    EXPECT_GT(mesh.triangles.size(), 100'000u);
    return mesh;
}

/// The same without the triangles around a pole.
inline Mesh fine_bowl() {
    Mesh mesh = fine_ball();
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z > 0.9; });
    EXPECT_GT(mesh.triangles.size(), 100'000u);
    return mesh;
}

} // namespace foam::test
