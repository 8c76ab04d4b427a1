#include "robot.hpp"

#include "mesh_files.hpp"
#include "pose.hpp"
#include "urdf.hpp"

#include <algorithm>

namespace judge {
namespace {

Real size_of(const std::vector<Corners>& triangles) {
    Real size = 0;
    for (const Corners& corners : triangles) {
        for (const Point& p : corners) {
            size = std::max(size, length(p));
        }
    }
    return size;
}

Part placed(std::vector<Corners> triangles, const Placement& place, const Point& scale) {
    const bool scaled = scale.x != 1 || scale.y != 1 || scale.z != 1;
    for (Corners& corners : triangles) {
        for (Point& p : corners) {
            p = {p.x * scale.x, p.y * scale.y, p.z * scale.z};
        }
    }
    Part part;
    part.rounding = placement_error(place, scaled, size_of(triangles));
    for (Corners& corners : triangles) {
        for (Point& p : corners) {
            p = place.apply(p);
        }
    }
    part.triangles = std::move(triangles);
    return part;
}

std::vector<Corners> box(const Point& size) {
    const auto corner = [&](unsigned bits) {
        const auto side = [](bool far, Real edge) { return far ? edge / 2 : -edge / 2; };
        return Point{side(bits & 1, size.x), side(bits & 2, size.y), side(bits & 4, size.z)};
    };
    constexpr unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::vector<Corners> triangles;
    for (const auto& face : faces) {
        for (unsigned k = 2; k < 4; ++k) {
            triangles.push_back({corner(face[0]), corner(face[k - 1]), corner(face[k])});
        }
    }
    return triangles;
}

Part round_part(const Element& shape, const Placement& place) {
    Part part;
    part.kind = shape.name == "sphere"     ? Part::Kind::sphere
                : shape.name == "cylinder" ? Part::Kind::cylinder
                                           : Part::Kind::capsule;
    part.radius = numbers_of(shape.attribute("radius")).at(0);
    part.length = part.kind == Part::Kind::sphere ? 0 : numbers_of(shape.attribute("length")).at(0);
    part.center = place.offset;
    part.across = place.x;
    part.up = place.y;
    part.axis = place.z;
    part.rounding = placement_error(place, false, part.radius + part.length);
    return part;
}

Part part_of(const Element& collision, const std::filesystem::path& folder) {
    const Placement place = placement_of(collision);
    const Element& shape = collision.at("geometry").children.at(0);
    if (shape.name == "mesh") {
        return placed(read_triangles(resolved(shape.attribute("filename"), folder)), place,
                      vector_of(shape.attribute("scale"), {1, 1, 1}));
    }
    if (shape.name == "box") {
        return placed(box(vector_of(shape.attribute("size"), {})), place, {1, 1, 1});
    }
    return round_part(shape, place);
}

std::vector<Link> read_urdf(const std::filesystem::path& file) {
    std::vector<Link> links;
    for (const LinkCollisions& given : collisions_of(file)) {
        Link link{given.link, {}};
        for (const Element& collision : given.collisions) {
            link.parts.push_back(part_of(collision, file.parent_path()));
        }
        links.push_back(std::move(link));
    }
    return links;
}

} // namespace

std::vector<Link> read_original(const std::filesystem::path& file) {
    return is_mesh(file) ? std::vector<Link>{{"", {placed(read_triangles(file), {}, {1, 1, 1})}}} : read_urdf(file);
}

Body body_of(const Part& part) {
    const Placement place{part.across, part.up, part.axis, part.center, true};
    return part.kind == Part::Kind::cylinder ? cylinder(place, part.length / 2, part.radius)
                                             : rounded_box(place, {0, 0, part.length / 2}, part.radius);
}

} // namespace judge
