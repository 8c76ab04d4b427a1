#include "link_shapes.hpp"

#include <foam/collision/separation.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/robot/internal/chain.hpp>

#include <algorithm>

namespace foam::inline collision {

namespace {

/// Returns the primitives of a link; nothing if it has a mesh.
std::optional<self_collision::BallGroup> primitives_of(const Solid& solid) {
    Elements elements;
    for (const Solid::Part& part : solid.parts()) {
        if (!part.primitive) {
            return std::nullopt;
        }
        elements.add(moved(*part.primitive, part.pose));
    }
    return self_collision::BallGroup(elements);
}

} // namespace

LinkShapes::LinkShapes(const LinkSolids& solids) : solids_(solids), shapes_(solids.size()) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
        if (has(i)) {
            shapes_[i].primitives = primitives_of(*solids[i]);
            const Box& box = solids[i]->bounds();
            shapes_[i].around =
                shapes_[i].primitives ? shapes_[i].primitives->bound : Sphere{box.center(), box.diagonal() / 2};
        }
    }
}

std::vector<bool> LinkShapes::have_geometry() const {
    std::vector<bool> have(solids_.size());
    for (std::size_t i = 0; i < solids_.size(); ++i) {
        have[i] = has(i);
    }
    return have;
}

const ContactShape& LinkShapes::mesh(std::size_t link) const {
    Shape& shape = shapes_[link];
    std::call_once(shape.made, [&] { shape.mesh = std::make_unique<ContactShape>(solids_[link]); });
    return *shape.mesh;
}

bool LinkShapes::touching(std::size_t first, std::size_t second, std::span<const Pose> poses) const {
    using namespace self_collision;
    if (!has(first) || !has(second) ||
        !touch(moved(poses[first], shapes_[first].around), moved(poses[second], shapes_[second].around))) {
        return false;
    }
    if (shapes_[first].primitives && shapes_[second].primitives) {
        return touch(*shapes_[first].primitives, poses[first], *shapes_[second].primitives, poses[second]);
    }
    const ContactShape &a = mesh(first), &b = mesh(second);
    return touch(moved(poses[first], a.bound()), moved(poses[second], b.bound())) &&
           a.touches(b, poses[first].inverse() * poses[second]);
}

LinkPairs pairs_apart(const Kinematics& kinematics, const LinkShapes& shapes) {
    const std::vector<bool> have = shapes.have_geometry();
    LinkPairs pairs;
    for (std::size_t a = 0; a < have.size(); ++a) {
        for (std::size_t b = a + 1; b < have.size(); ++b) {
            if (have[a] && have[b] && !joint_chain::adjacent(kinematics, have, a, b)) {
                pairs.emplace_back(a, b);
            }
        }
    }
    return pairs;
}

LinkPairs touching_in_all(const Kinematics& kinematics, const LinkShapes& shapes, LinkPairs pairs,
                          const std::vector<std::vector<double>>& configurations) {
    PlacedShapes placed(kinematics, shapes);
    for (const std::vector<double>& configuration : configurations) {
        if (pairs.empty()) {
            break;
        }
        placed.place(configuration);
        std::erase_if(pairs, [&](const auto& pair) { return !placed.touching(pair.first, pair.second); });
    }
    return pairs;
}

} // namespace foam::inline collision

namespace foam::inline collision::self_collision {

bool shaped_touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b) {
    const auto meet = [&](const Element& e, const Sphere& bound_of_e, const Element& f, const Sphere& bound_of_f) {
        return touch(moved(pose_a, bound_of_e), moved(pose_b, bound_of_f)) && separation(e, f, pose_a, pose_b).low == 0;
    };
    for (const BoundedElement& f : b.shaped) {
        for (const BoundedElement& e : a.shaped) {
            if (meet(e.element, e.bound, f.element, f.bound)) {
                return true;
            }
        }
        for (const Sphere& e : a.spheres) {
            if (meet(element_of(e), e, f.element, f.bound)) {
                return true;
            }
        }
    }
    for (const BoundedElement& e : a.shaped) {
        for (const Sphere& f : b.spheres) {
            if (meet(e.element, e.bound, element_of(f), f)) {
                return true;
            }
        }
    }
    return false;
}

bool touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b) {
    const Sphere bound_of_a = moved(pose_a, a.bound);
    std::vector<Sphere> near;
    for (const Sphere& sphere : b.spheres) {
        if (const Sphere here = moved(pose_b, sphere); touch(bound_of_a, here)) {
            near.push_back(here);
        }
    }
    const auto touches_near = [&](const Sphere& sphere) {
        const Sphere here = moved(pose_a, sphere);
        return std::any_of(near.begin(), near.end(), [&](const Sphere& other) { return touch(here, other); });
    };
    return (!near.empty() && std::any_of(a.spheres.begin(), a.spheres.end(), touches_near)) ||
           shaped_touch(a, pose_a, b, pose_b);
}

} // namespace foam::inline collision::self_collision
