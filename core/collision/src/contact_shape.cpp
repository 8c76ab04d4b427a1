#include "link_shapes.hpp"

#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/inscribed_mesh.hpp>
#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/internal/triangles.hpp>

#include <algorithm>

namespace foam::inline collision {
namespace {

Mesh mesh_within(const Solid& solid) {
    constexpr int segments = 96; // a radius is off by 0.05 %
    Mesh mesh;
    for (const Solid::Part& part : solid.parts()) {
        append(mesh, part.primitive ? inscribed_mesh(moved(*part.primitive, part.pose), segments) : *part.mesh);
    }
    return mesh;
}

std::vector<Vec3> vertices_of_pieces(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = welded_indices(mesh);
    DisjointSets sets(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        sets.unite(welded[a], welded[b]);
        sets.unite(welded[b], welded[c]);
    }
    std::vector<char> known(mesh.vertices.size(), 0);
    std::vector<Vec3> vertices;
    for (const Triangle& triangle : mesh.triangles) {
        const std::uint32_t piece = sets.find(welded[triangle[0]]);
        if (!known[piece]) {
            known[piece] = 1;
            vertices.push_back(mesh.vertices[piece]);
        }
    }
    return vertices;
}

/// Returns the box around a node's box after it was moved.
Box moved_box(const Pose& pose, const BvhNode& node) {
    Box box;
    box.add(node.low);
    box.add(node.high);
    return posed(box, pose);
}

} // namespace

ContactShape::ContactShape(std::shared_ptr<const Solid> solid)
    : solid_(std::move(solid)), mesh_(mesh_within(*solid_)), of_pieces_(vertices_of_pieces(mesh_)),
      bound_(minimum_enclosing_sphere(mesh_.vertices)) {
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        Box& box = boxes_.emplace_back();
        for (const Vec3& corner : corners(i)) {
            box.add(corner);
        }
    }
    bvh_ = Bvh(boxes_);
}

TriangleCorners ContactShape::corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
}

bool ContactShape::crosses(const ContactShape& other, const Pose& pose) const {
    bool found = false;
    const BvhNode& whole = bvh_.nodes().front();
    const auto may_touch = [&](const BvhNode& node) { return !found && overlap(moved_box(pose, node), whole); };
    for_each_entered(other.bvh_, may_touch, [&](std::uint32_t place) {
        TriangleCorners theirs = other.corners(other.bvh_.order()[place]);
        Box box;
        for (Vec3& corner : theirs) {
            corner = pose * corner;
            box.add(corner);
        }
        const auto is_near = [&](const BvhNode& node) { return !found && overlap(node, box); };
        for_each_entered(bvh_, is_near, [&](std::uint32_t own_place) {
            const std::uint32_t own = bvh_.order()[own_place];
            if (!found && overlap(boxes_[own], box)) {
                const TriangleCorners ours = corners(own);
                found = side_passes_through(ours, theirs) || side_passes_through(theirs, ours);
            }
        });
    });
    return found;
}

bool ContactShape::holds_piece_of(const ContactShape& other, const Pose& pose) const {
    return std::any_of(other.of_pieces_.begin(), other.of_pieces_.end(), [&](const Vec3& vertex) {
        const Vec3 here = pose * vertex;
        return squared_norm(here - bound_.center) <= bound_.radius * bound_.radius && solid_->contains(here);
    });
}

bool ContactShape::touches(const ContactShape& other, const Pose& pose) const {
    return crosses(other, pose) || holds_piece_of(other, pose) || other.holds_piece_of(*this, pose.inverse());
}

} // namespace foam::inline collision
