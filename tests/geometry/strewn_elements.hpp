// Elements here and there on a mesh.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/element.hpp>

#include <array>
#include <vector>

namespace foam::test {

/// Boxes, balls and capsules about random places of a surface.
inline std::vector<Element> strewn(const Mesh& mesh, int count, double size, Random& random) {
    std::vector<Element> elements;
    using Kind = Element::Kind;
    for (int k = 0; k < count; ++k) {
        Element e{.kind = std::array{Kind::box, Kind::sphere, Kind::capsule}[static_cast<std::size_t>(k % 3)]};
        e.pose = random_pose(random, 0);
        e.pose.translation = mesh.vertices[random.below(mesh.vertices.size())];
        e.radius = e.kind == Kind::box ? 0 : size;
        e.half = e.kind == Kind::box ? Vec3{size, size, size} : e.kind == Kind::capsule ? Vec3{0, 0, size} : Vec3{};
        elements.push_back(e);
    }
    return elements;
}

} // namespace foam::test
