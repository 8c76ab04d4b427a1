#include <foam/geometry/internal/digest.hpp>

namespace foam::inline geometry {

void add_to(Hasher& hasher, const Vec3& v) {
    hasher.add(v.x).add(v.y).add(v.z);
}

void add_to(Hasher& hasher, const Pose& pose) {
    for (const Vec3& row : pose.rotation) {
        hasher.add(row);
    }
    hasher.add(pose.translation);
}

void add_to(Hasher& hasher, const Mesh& mesh) {
    hasher.add(static_cast<std::uint64_t>(mesh.vertices.size()));
    hasher.bytes(mesh.vertices.data(), mesh.vertices.size() * sizeof(Vec3));
    hasher.add(static_cast<std::uint64_t>(mesh.triangles.size()));
    hasher.bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
}

void add_primitive(Hasher& hasher, const Element& primitive) {
    const bool has_size = primitive.kind == Element::Kind::box || primitive.kind == Element::Kind::ellipsoid;
    const Vec3 size = has_size ? primitive.half * 2 : Vec3{}; // in the form of epochs before, whose seeds stay
    hasher.add(to_string(primitive.kind)).add(size).add(primitive.radius).add(has_size ? 0 : 2 * primitive.half.z);
}

void add_to(Hasher& hasher, const Element& element) {
    hasher.add(to_string(element.kind)).add(element.pose).add(element.half).add(element.radius);
    if (element.hull) {
        hasher.add(element.hull->surface).add(static_cast<std::uint64_t>(element.hull->faces.size()));
        for (const Polytope::Face& face : element.hull->faces) {
            hasher.add(face.normal).add(face.offset);
        }
    }
}

void add_to(Hasher& hasher, const SphereTree& tree) {
    hasher.add(static_cast<std::uint64_t>(tree.levels.size()));
    for (const SphereTree::Level& level : tree.levels) {
        hasher.add(static_cast<std::uint64_t>(level.elements.spheres().size()));
        for (const Sphere& sphere : level.elements.spheres()) {
            hasher.add(sphere.center).add(sphere.radius);
        }
        hasher.add(static_cast<std::uint64_t>(level.parents.size()));
        hasher.bytes(level.parents.data(), level.parents.size() * sizeof(std::uint32_t));
        if (!level.elements.are_spheres()) { // spheres alone keep their digests
            hasher.add(static_cast<std::uint64_t>(level.elements.shaped().size()));
            for (const Element& element : level.elements.shaped()) {
                hasher.add(element);
            }
        }
    }
}

void add_to(Hasher& hasher, const Measures& m) {
    hasher.add(static_cast<std::uint64_t>(m.spheres)).add(static_cast<std::uint64_t>(m.certified));
    for (const double figure : {m.area, m.volume, m.covered, m.gap, m.excess, m.excess_error, m.missing,
                                m.missing_error, m.exposed_area, m.protrusion_max, m.protrusion_mean, m.excess_volume,
                                m.missing_volume, m.excess_volume_error, m.missing_volume_error, m.volume_error}) {
        hasher.add(figure);
    }
}

} // namespace foam::inline geometry
