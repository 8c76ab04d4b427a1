// Meshes made on the spot, sound and defective.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <string>
#include <vector>

namespace foam::test {

/// 12 triangles, outward.
Mesh box(const Vec3& center, const Vec3& size);
/// Rings and sectors with poles, outward.
Mesh ball(const Vec3& center, double radius, int sectors = 32);
Mesh torus(double major, double minor, int sectors = 48);
/// A tube without caps, standing on z = 0.
Mesh open_cylinder(double radius, double height, int sectors = 32);
/// An n × n grid of squares in the plane z = 0.
Mesh flat_grid(int n);
/// Random triangles in the unit cube.
Mesh soup(int triangles);
/// Vertices displaced at random by up to `amplitude` along each axis.
Mesh noisy(Mesh mesh, double amplitude);

Mesh reversed(Mesh mesh);
/// Without the triangles first, first + 1, ..., first + count - 1.
Mesh without(Mesh mesh, std::size_t first, std::size_t count);
Mesh united(Mesh a, const Mesh& b);
Mesh scaled(Mesh mesh, double factor, const Vec3& shift = {});

struct Named {
    std::string name;
    Mesh mesh;
};
/// Closed 2-manifolds that face outwards.
std::vector<Named> sound_meshes();
/// Everything else that has a triangle with an area.
std::vector<Named> defective_meshes();

/// Finite coordinates, indices in range, and at least one triangle.
bool is_usable(const Mesh& mesh);

} // namespace foam::test
