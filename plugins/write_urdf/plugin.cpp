// Writers of robots in URDF.
//
// write.urdf: the robot's URDF text with spheres and other elements in place of its collision geometry. Meshes of hulls
// lie beside it. Everything else keeps its bytes: comments, unknown elements, order, line ends, encoding. The
// exceptions: paths of the remaining meshes and textures (visuals, links without spheres), and what parameters add.
//
// write.xacro: the elements alone, as macros.
//
// write.vamp: the same for VAMP, whose planner takes every joint that is not fixed as its own.
#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam {
namespace {

InertialOf inertial_of(const std::string& word) {
    return word == "keep" ? InertialOf::none : word == "moving" ? InertialOf::moving : InertialOf::all;
}

bool is_for(const Parameters& parameters, std::string_view engine) {
    return parameters.text("engine") == engine;
}

class UrdfWriter final : public Writer {
public:
    explicit UrdfWriter(const Parameters& parameters)
        : level_(static_cast<int>(parameters.integer("level"))), mesh_paths_(parameters.text("mesh_paths")),
          inertial_(inertial_of(parameters.text("inertial"))), density_(parameters.number("density")),
          drake_(parameters.boolean("drake") || is_for(parameters, "drake")),
          proximity_(proximity_properties(parameters.number("mu_static"), parameters.number("mesh_resolution_hint"))) {
        // They have a word for capsules, and the cylinders of two are not round.
        const bool own_word = parameters.text("capsules") == "element" || is_for(parameters, "coal") ||
                              is_for(parameters, "physx") || is_for(parameters, "pybullet");
        capsule_ = drake_ ? "drake:capsule" : own_word ? "capsule" : "";
        mesh_paths_ = mesh_paths_ == "rewrite" && is_for(parameters, "pybullet") ? "absolute" : mesh_paths_;
        known_.engine = engine_of(parameters);
        known_.ellipsoids = drake_;
        known_.segments = segments_of(parameters, "write.urdf");
    }

    std::string write(const SphereModel& model, Context& context) const override {
        if (!drake_ && !proximity_.empty()) {
            throw Error(ErrorCode::output, "write.urdf: mu_static and mesh_resolution_hint are properties that only "
                                           "Drake reads; remedy: drake: true");
        }
        SphereUrdf urdf(model, "write.urdf");
        urdf.put_elements(
            in_known_kinds(elements_by_link(model, level_), known_),
            {.capsule = capsule_, .declares_convex = drake_, .properties = proximity_},
            mesh_paths_, context);
        urdf.move_references(mesh_paths_, context);
        if (inertial_ != InertialOf::none) {
            add_inertials(urdf, inertial_, density_, context);
        }
        if (drake_) {
            declare_drake(urdf);
            add_collision_filter_groups(urdf, context);
        }
        return urdf.result();
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>& beside) const override {
        return held_by(known_.engine, elements_of_urdf(bytes, beside));
    }

    std::map<std::string, std::string> files_beside(const SphereModel& model, Context&) const override {
        return hull_files(in_known_kinds(elements_by_link(model, level_), known_), file_name_of(model));
    }

private:
    int level_;
    std::string mesh_paths_;
    InertialOf inertial_;
    double density_;
    bool drake_;
    std::string capsule_, proximity_;
    KnownKinds known_;
};

StageInfo info_of_urdf() {
    return {
        .name = "write.urdf",
        .summary = "Writes the robot's URDF text with spheres and other elements in place of its collision geometry, "
                   "and nothing else changed but relative paths.",
        .reference = "http://wiki.ros.org/urdf/XML",
        .parameters =
            {Parameter::integer("level", -1)
                 .bounds(-1, 32)
                 .doc("Level of the sphere trees that is written: 0 the bounding spheres, -1 the finest.")
                 .source("The finest level is the one that is measured and proved."),
             engine_parameter("write.urdf"),
             mesh_paths_parameter(),
             Parameter::choice("capsules", {"as_parts", "element"}, "as_parts")
                 .doc("as_parts: a capsule is a cylinder and two spheres, which every program reads, and foam reads as "
                      "one capsule again; element: <capsule> of URDF 1.1. With drake: <drake:capsule> in any case.")
                 .source("yourdfpy, and urdfdom before 5.1, refuse a robot with <capsule>; Pinocchio, MuJoCo, Drake, "
                         "PyBullet, Newton and Tesseract read it."),
             segments_parameter(),
             Parameter::choice("inertial", {"keep", "moving", "all"}, "keep")
                 .doc("keep: links without <inertial> stay so. moving: those that a joint moves get that of their "
                      "original collision geometry. all: all links that have geometry get it, for Gazebo, which "
                      "drops links without <inertial>."),
             Parameter::number("density", 1000)
                 .bounds(1e-3, 1e5)
                 .unit("kg/m³")
                 .doc("Density of the geometry for <inertial> that is added.")
                 .source("Water; a robot arm of aluminium, motors and air is of this order."),
             Parameter::boolean("drake", false)
                 .doc("Add what Drake reads: its namespace, and pairs of links that need no check as groups that "
                      "ignore each other."),
             Parameter::number("mu_static", 0)
                 .bounds(0, 100)
                 .unit("1")
                 .doc("With drake: the coefficient of static friction of all spheres; 0: none is written."),
             Parameter::number("mesh_resolution_hint", 0)
                 .bounds(0, 100)
                 .unit("m")
                 .doc("With drake: the length of edges for hydroelastic contact, about one to two times the radius "
                      "of a sphere; 0: none is written.")},
        .extensions = {"urdf"},
        .kinds = every_kind(),
        .consumer = {.name = "urdfdom 3.0.1, Pinocchio 3.7, Drake (018bf81c12), Bullet, DART 6.12, Gazebo, Tesseract",
                     .pairs = true,
                     .pairs_if = "drake"}};
}

} // namespace
} // namespace foam

FOAM_PLUGIN("write_urdf", "1.0", "Apache-2.0") {
    enrol.add<foam::UrdfWriter>(foam::info_of_urdf());
    enrol.add<foam::XacroWriter>(foam::info_of_xacro());
    enrol.add<foam::VampWriter>(foam::info_of_vamp());
}
