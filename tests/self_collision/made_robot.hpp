// Robots whose answer is known: links of spheres, one by one, and pairs of their matrix.
#pragma once

#include <foam/collision/self_collision.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace foam::test {

inline constexpr auto turns = Joint::Kind::revolute;
inline constexpr auto slides = Joint::Kind::prismatic;
inline constexpr auto fixed = Joint::Kind::fixed;

/// Links and joints one by one; a joint without limits given turns or slides by them.
class Builder {
public:
    Builder& link(const std::string& name, std::vector<Sphere> spheres = {}) {
        robot_.links.push_back({.name = name, .collisions = {}, .visuals = {}});
        elements_.push_back(std::move(spheres));
        return *this;
    }
    Builder& joint(Joint::Kind kind, const std::string& parent, const std::string& child, const Vec3& at = {},
                   double lower = 0, double upper = 0, const Vec3& axis = {0, 0, 1}) {
        robot_.joints.push_back({.name = parent + "_" + child,
                                 .kind = kind,
                                 .parent = parent,
                                 .child = child,
                                 .origin = Pose::from_xyz_rpy(at, {}),
                                 .axis = normalized(axis),
                                 .lower = lower,
                                 .upper = upper});
        return *this;
    }
    /// Makes the last joint follow another.
    Builder& mimic(const std::string& joint) {
        robot_.joints.back().mimic = Mimic{.joint = joint};
        return *this;
    }
    CollisionModel model() const {
        Robot robot = robot_;
        robot.name = "made";
        robot.root = robot.links.front().name;
        return {std::make_shared<const Robot>(robot),
                elements_,
                std::vector<CollisionModel::Source>(elements_.size(), CollisionModel::Source::geometry),
                {}};
    }
    SelfCollisionMatrix matrix(const SelfCollisionOptions& options = {}) const {
        const CollisionModel made = model();
        return self_collision_matrix(Kinematics(made.robot), made, options);
    }

private:
    Robot robot_;
    std::vector<Elements> elements_;
};

/// Returns the spheres as original geometry.
inline LinkSolids solids_of_spheres(const CollisionModel& model) {
    LinkSolids solids;
    for (const Elements& elements : model.elements) {
        std::vector<Solid::Part> parts;
        for (const Sphere& sphere : elements.spheres()) {
            parts.push_back({nullptr, Element::sphere(sphere.radius), Pose::from_xyz_rpy(sphere.center, {})});
        }
        solids.push_back(parts.empty() ? nullptr : Solid::make(std::move(parts)));
    }
    return solids;
}

/// Two links of 1 m in a plane. The hand at the end is 2 |cos(elbow / 2)| from the base; they touch at 0.5 m.
inline Builder arm(double lower, double upper) {
    return Builder()
        .link("base", {{{0, 0, 0}, 0.3}})
        .link("upper", {{{0.5, 0, 0}, 0.05}})
        .link("lower")
        .link("hand", {{{0, 0, 0}, 0.2}})
        .joint(turns, "base", "upper", {}, -3, 3)
        .joint(turns, "upper", "lower", {1, 0, 0}, lower, upper)
        .joint(fixed, "lower", "hand", {1, 0, 0});
}

inline const double touches_from = 2 * std::acos(0.25); // of the elbow, to π

inline const LinkPair& pair(const SelfCollisionMatrix& matrix, std::size_t first, std::size_t second) {
    for (const LinkPair& candidate : matrix.pairs) {
        if (candidate.first == first && candidate.second == second) {
            return candidate;
        }
    }
    throw std::out_of_range("no such pair");
}

/// A model whose geometry are its spheres with a share of their radii.
inline CollisionModel model_with_geometry(const Builder& builder, double share, CollisionModel::Source source) {
    CollisionModel model = builder.model();
    model.sources.assign(model.sources.size(), source);
    CollisionModel small = model;
    for (Elements& elements : small.elements) {
        for (Sphere& sphere : elements.spheres()) {
            sphere.radius *= share;
        }
    }
    model.solids = solids_of_spheres(small);
    return model;
}

inline SelfCollisionMatrix matrix_of(const CollisionModel& model, const SelfCollisionOptions& options = {}) {
    return self_collision_matrix(Kinematics(model.robot), model, options);
}

/// The base and the hand of an arm that always touch by their spheres, with geometry of a tenth of the radius or more.
inline LinkPair with_geometry(double share, CollisionModel::Source source, double lower = 3, double upper = 3.1,
                       std::size_t samples = 3000) {
    return pair(matrix_of(model_with_geometry(arm(lower, upper), share, source), {.samples = samples}), 0, 3);
}

} // namespace foam::test
