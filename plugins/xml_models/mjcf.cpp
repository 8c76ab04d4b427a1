// The traps of MuJoCo's parser are named where they are met; docs: doc/XMLreference.rst (a7255075b0).
#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::xml_models {
namespace {

std::string pose_text(const Pose& pose) {
    const bool moved = pose.translation != Vec3{}, turned = pose.rotation != Pose{}.rotation;
    return (moved ? attribute_text("pos", vector_text(pose.translation)) : "") +
           (turned ? attribute_text("quat", numbers_text(quaternion(pose))) : "");
}

/// Returns the mass properties that a robot states, in the link's frame: fullinertia of MJCF allows no orientation.
MassProperties stated_mass(const Inertial& inertial, const Robot& robot, const std::string& link) {
    if (!inertial.problem.empty()) {
        throw Error(ErrorCode::input, inertial.problem);
    }
    if (!inertial.mass || !inertial.moments) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: <inertial> needs <mass> and <inertia> for MuJoCo",
                                inertial.line > 0 ? fmt::format("{}:{}", robot.file.string(), inertial.line)
                                                  : fmt::format("link '{}'", shown(link))));
    }
    const auto& [xx, yy, zz, xy, xz, yz] = *inertial.moments;
    const Vec3 rows[3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
    const auto turned = [&](std::size_t i, std::size_t j) { // (R I Rᵀ)ᵢⱼ
        const Vec3& a = inertial.origin.rotation[i];
        const Vec3& b = inertial.origin.rotation[j];
        return dot(a, {dot(rows[0], b), dot(rows[1], b), dot(rows[2], b)});
    };
    return {.mass = *inertial.mass,
            .center = inertial.origin.translation,
            .inertia = {turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(0, 2), turned(1, 2)}};
}

/// Least mass and least moment of inertia that are written, in kg and kg m²: MuJoCo refuses those below mjEPS, 1e-14,
/// and rounds in between (user_objects.cc of 2.2.2 and 3.14).
constexpr double least_inertia = 2e-14;

/// Returns the principal moments of inertia, ascending.
Eigen::Vector3d principal_moments(const MassProperties& mass) {
    const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
    Eigen::Matrix3d inertia;
    inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Returns whether a body can have the mass: positive, and moments of inertia that are positive and of which none is
/// larger than the sum of the others.
bool is_of_a_body(const MassProperties& mass) {
    constexpr double rounding = 1e-14; // of the largest moment
    const Eigen::Vector3d moments = principal_moments(mass);
    return mass.mass > 0 && moments[0] > rounding * moments[2] && moments[0] + moments[1] >= moments[2] * (1 - 1e-9);
}

/// Raises a mass that MuJoCo refuses, and all moments by the same, so that they stay those of a body. Returns whether
/// it did.
bool raise(MassProperties& mass) {
    const double missing = least_inertia - principal_moments(mass)[0];
    if (mass.mass >= least_inertia && missing <= 0) {
        return false;
    }
    mass.mass = std::max(mass.mass, least_inertia);
    for (std::size_t i = 0; i < 3; ++i) { // xx yy zz
        mass.inertia[i] += std::max(missing, 0.0);
    }
    return true;
}

/// The order of fullinertia is xx yy zz xy xz yz.
std::string inertial_text(const MassProperties& mass) {
    return "<inertial" + attribute_text("pos", vector_text(mass.center)) +
           attribute_text("mass", numbers_text({&mass.mass, 1})) +
           attribute_text("fullinertia", numbers_text(mass.inertia)) + "/>";
}

/// Returns the mass properties of the spheres: the volume of their union, spread like their volumes.
MassProperties of_spheres(const std::vector<Sphere>& spheres, double density) {
    double total = 0;
    MassProperties result;
    for (const Sphere& s : spheres) {
        const double weight = s.radius * s.radius * s.radius;
        total += weight;
        result.center += s.center * weight;
    }
    result.center = result.center / total;
    result.mass = density * exact_union_volume(spheres);
    auto& [xx, yy, zz, xy, xz, yz] = result.inertia;
    for (const Sphere& s : spheres) {
        const double part = result.mass * s.radius * s.radius * s.radius / total, own = 0.4 * s.radius * s.radius;
        const Vec3 d = s.center - result.center;
        xx += part * (own + d.y * d.y + d.z * d.z);
        yy += part * (own + d.x * d.x + d.z * d.z);
        zz += part * (own + d.x * d.x + d.y * d.y);
        xy -= part * d.x * d.y;
        xz -= part * d.x * d.z;
        yz -= part * d.y * d.z;
    }
    return result;
}

/// Returns the mass properties of the union of the elements.
std::optional<MassProperties> of_elements(const Elements& elements, double density) {
    std::vector<Solid::Part> parts;
    for (const Sphere& s : elements.spheres()) {
        parts.push_back({nullptr, Element::sphere(s.radius), Pose{.translation = s.center}});
    }
    for (const Element& element : elements.shaped()) {
        parts.push_back({std::make_shared<const Mesh>(enclosing_mesh(element)), std::nullopt, Pose{}});
    }
    return mass_properties(*Solid::make(std::move(parts)), density);
}

constexpr const char* world = "world"; ///< MuJoCo's name of the body that everything stands on

/// Writes the tree of bodies.
class Bodies {
public:
    Bodies(const SphereModel& model, const KnownKinds& known, bool free, double density, Context& context)
        : model_(model), context_(context), kinematics_(model.robot), free_(free), density_(density) {
        for (LinkSpheres& link : in_known_kinds(elements_by_link(model), known)) {
            elements_[link.link] = std::move(link.elements);
        }
        keep_geometry();
        const PlannedJoints joints = planned_joints(model);
        for (const auto& [joint, position] : joints.locked) {
            locked_[joint] = position;
        }
    }

    std::string text() {
        const std::string base = base_link(model_);
        for (const Link& link : model_.robot->links) {
            if (link.name == world && (link.name != base || free_ || !elements_[world].empty())) {
                throw Error(ErrorCode::output, "write.mjcf: a link is called 'world', which is MuJoCo's own body; "
                                               "remedy: rename the link, unless it is a fixed base without spheres");
            }
        }
        if (base == world) {
            add_children(base, 2);
        } else {
            add_body(base, {}, nullptr, 2);
        }
        if (!impossible_.empty()) {
            context_.log(
                Severity::warning,
                fmt::format("MuJoCo refuses the inertia that the URDF states for {}: no body has it; the mass "
                            "stays, centre and inertia are those of the geometry, of the spheres where it has no "
                            "volume, or of a ball of water where there is neither; remedy: correct <inertial>",
                            fmt::join(impossible_, ", ")));
        }
        if (!raised_.empty()) {
            context_.log(Severity::warning,
                         fmt::format("MuJoCo refuses a mass below 1e-14 kg and a moment of inertia below 1e-14 kg m²; "
                                     "those of {} are raised to at least 2e-14; remedy: a robot in other units, such "
                                     "as millimetres",
                                     fmt::join(raised_, ", ")));
        }
        tell(from_geometry_, "the collision geometry");
        tell(from_open_, "the collision geometry, whose meshes are not closed: the winding number decides what lies "
                         "inside,");
        tell(from_spheres_, "the spheres, as the geometry is not known or has no volume,");
        tell(from_elements_, "the elements, as the geometry is not known or has no volume,");
        return std::move(text_);
    }

    /// Returns the <asset> with the meshes of hulls; empty without hulls. Call it after text().
    std::string assets() const {
        std::string text;
        for (const std::string& mesh : shapes_.meshes()) {
            text += "    " + mesh + "\n";
        }
        return text.empty() ? "" : "  <asset>\n" + text + "  </asset>\n";
    }
    /// Returns the <keyframe> with the rest pose; empty where all joints rest at zero. Call it after text(): qpos has
    /// the order of the bodies.
    std::string keyframe() const {
        JointValues values = model_.facts.default_pose;
        values.insert(locked_.begin(), locked_.end());
        const std::vector<double> configuration = kinematics_.configuration(values);
        std::vector<double> positions;
        if (free_) {
            positions = {0, 0, 0, 1, 0, 0, 0};
        }
        bool moved = false;
        for (const std::size_t joint : joints_) {
            const JointMotion& motion = kinematics_.motions()[joint];
            const double turned = motion.freedom ? motion.multiplier * configuration[*motion.freedom] : 0;
            positions.push_back(motion.offset + turned);
            moved = moved || positions.back() != 0;
        }
        return moved ? "  <keyframe>\n    <key name=\"home\"" + attribute_text("qpos", numbers_text(positions)) +
                           "/>\n  </keyframe>\n"
                     : "";
    }
    bool has_shaped() const {
        return std::any_of(elements_.begin(), elements_.end(),
                           [](const auto& link) { return !link.second.are_spheres(); });
    }

private:
    /// Adds the primitives of links without elements, which keep their collision geometry.
    void keep_geometry() {
        const std::vector<std::string>& none = model_.without_collision;
        for (const std::string& name : uncovered_links(model_)) {
            const Link* link = model_.robot->find_link(name);
            if (!link || std::find(none.begin(), none.end(), name) != none.end()) {
                continue;
            }
            bool meshes = false;
            for (const GeometryElement& geometry : link->collisions) {
                const auto* primitive = std::get_if<Element>(&geometry.geometry);
                meshes = meshes || !primitive;
                if (!primitive) {
                    continue;
                }
                elements_[name].add(moved(*primitive, geometry.origin));
            }
            if (meshes) {
                context_.log(
                    Severity::warning,
                    fmt::format("link '{}' has no elements, and its collision meshes are not in the file: without "
                                "contact in MuJoCo; remedy: elements for it",
                                shown(name)));
            }
        }
    }
    /// Says which links have an invented mass.
    void tell(const std::vector<std::string>& links, const std::string& source) {
        if (!links.empty()) {
            context_.log(
                Severity::warning,
                fmt::format("no <inertial> with a mass: {} at {} kg/m³ gives that of {}; remedy: add <inertial> to the "
                            "URDF",
                            source, numbers_text({&density_, 1}), fmt::join(links, ", ")));
        }
    }

    void line(std::size_t depth, const std::string& content) { text_ += std::string(2 * depth, ' ') + content + "\n"; }

    void add_body(const std::string& link, const Pose& pose, const Joint* joint, std::size_t depth) {
        line(depth, "<body" + attribute_text("name", link) + pose_text(pose) + ">");
        const bool moves = joint ? joint->kind != Joint::Kind::fixed && !locked_.contains(joint->name) : free_;
        if (!joint && free_) {
            line(depth + 1, "<freejoint/>");
        }
        add_inertial(link, moves, depth + 1);
        if (joint && moves) {
            line(depth + 1, joint_text(*joint));
            joints_.push_back(static_cast<std::size_t>(joint - model_.robot->joints.data()));
        }
        for (const Sphere& s : elements_[link].spheres()) {
            line(depth + 1, "<geom class=\"sphere\"" + attribute_text("pos", vector_text(s.center)) +
                                attribute_text("size", numbers_text({&s.radius, 1})) + "/>");
        }
        for (const Element& element : elements_[link].shaped()) {
            line(depth + 1, "<geom class=\"element\"" + shapes_.attributes(element) + "/>");
        }
        add_children(link, depth + 1);
        line(depth, "</body>");
    }

    void add_children(const std::string& link, std::size_t depth) {
        for (const Joint& child : model_.robot->joints) {
            if (child.parent == link) {
                const auto held = locked_.find(child.name);
                add_body(child.child,
                         held == locked_.end() ? child.origin : child.origin * joint_motion(child, held->second),
                         &child, depth);
            }
        }
    }

    /// The spheres have no mass, as their overlaps would count twice; so every body that moves needs an <inertial>.
    void add_inertial(const std::string& link, bool moves, std::size_t depth) {
        const std::optional<Inertial>& inertial = model_.robot->find_link(link)->inertial;
        const auto stated = inertial ? std::optional(stated_mass(*inertial, *model_.robot, link)) : std::nullopt;
        if (stated && is_of_a_body(*stated)) {
            add_inertial(link, *stated, depth);
        } else if (stated && stated->mass > 0) {
            impossible_.push_back(link);
            add_inertial(link, repaired(link, *stated), depth);
        } else if (stated && !moves) {
            return; // a body of the world needs no mass
        } else if (const auto other = invented(link)) {
            other->from->push_back(link);
            add_inertial(link, other->mass, depth);
        } else if (moves) {
            throw Error(
                ErrorCode::output,
                fmt::format("write.mjcf: link '{}' moves, but has neither <inertial> nor spheres; MuJoCo refuses "
                            "moving bodies without mass; remedy: add <inertial> to the URDF",
                            link));
        }
    }

    void add_inertial(const std::string& link, MassProperties mass, std::size_t depth) {
        if (raise(mass)) {
            raised_.push_back(link);
        }
        line(depth, inertial_text(mass));
    }

    /// Returns the stated mass with the centre and inertia of the link's geometry; of a ball of water with that mass if
    /// the link has none.
    MassProperties repaired(const std::string& link, const MassProperties& stated) {
        MassProperties result;
        if (const auto other = invented(link)) {
            result = other->mass;
            for (double& moment : result.inertia) {
                moment *= stated.mass / result.mass;
            }
        } else {
            const double radius = std::cbrt(3 * stated.mass / (4 * std::numbers::pi * 1000));
            const double moment = 0.4 * stated.mass * radius * radius;
            result.center = stated.center;
            result.inertia = {moment, moment, moment, 0, 0, 0};
        }
        result.mass = stated.mass;
        return result;
    }

    /// Mass properties of a link that the URDF does not state, and the list of the links that have theirs from there.
    struct Invented {
        MassProperties mass;
        std::vector<std::string>* from = nullptr;
    };

    /// Returns those of the geometry, or else of the spheres; nothing for a link without both.
    std::optional<Invented> invented(const std::string& link) {
        if (const auto geometry = model_.geometry.find(link); geometry != model_.geometry.end()) {
            if (const auto mass = mass_properties(*geometry->second, density_)) {
                return Invented{*mass, geometry->second->closed() ? &from_geometry_ : &from_open_};
            }
        }
        const Elements& elements = elements_[link];
        if (!elements.are_spheres()) {
            if (const auto mass = of_elements(elements, density_)) {
                return Invented{*mass, &from_elements_};
            }
        }
        if (elements.spheres().empty()) {
            return {};
        }
        return Invented{of_spheres(elements.spheres(), density_), &from_spheres_};
    }

    std::string joint_text(const Joint& joint) const {
        if (joint.kind == Joint::Kind::planar || joint.kind == Joint::Kind::floating) {
            throw Error(ErrorCode::output,
                        fmt::format("write.mjcf: joint '{}' is {}, which MJCF has not within a robot; "
                                    "remedy: a fixed or revolute joint",
                                    joint.name, joint.kind == Joint::Kind::planar ? "planar" : "floating"));
        }
        std::string text = "<joint" + attribute_text("name", joint.name);
        text += joint.kind == Joint::Kind::prismatic ? attribute_text("type", "slide") : "";
        text += attribute_text("axis", vector_text(joint.axis));
        for (const Freedom& freedom : kinematics_.freedoms()) {
            if (freedom.joint == joint.name && joint.kind != Joint::Kind::continuous && freedom.lower < freedom.upper) {
                text += attribute_text("range", numbers_text(std::array{freedom.lower, freedom.upper}));
            }
        }
        return text + "/>";
    }

    const SphereModel& model_;
    Context& context_;
    Kinematics kinematics_;
    bool free_;
    double density_;                           ///< kg/m³
    std::map<std::string, Elements> elements_; ///< of each link
    MjcfShapes shapes_;
    std::vector<std::string> impossible_; ///< links whose stated inertia no body has
    std::vector<std::string> raised_;     ///< links whose mass or inertia is below what MuJoCo takes
    std::vector<std::string> from_geometry_, from_open_, from_spheres_,
        from_elements_; ///< links by what their mass is made of
    JointValues locked_;
    std::vector<std::size_t> joints_; ///< indices of those that move, in the order of the bodies
    std::string text_;
};

/// Returns the <equality> of joints that mimic others: joint1 = offset + multiplier · joint2.
std::string equality_text(const SphereModel& model) {
    const Kinematics kinematics(model.robot);
    std::string text;
    for (std::size_t i = 0; i < model.robot->joints.size(); ++i) {
        const JointMotion& motion = kinematics.motions()[i];
        const std::string& name = model.robot->joints[i].name;
        if (!motion.freedom || kinematics.freedoms()[*motion.freedom].joint == name) {
            continue;
        }
        const std::string& other = kinematics.freedoms()[*motion.freedom].joint;
        if (!model.facts.lock_joints.contains(other)) {
            text +=
                "    <joint" + attribute_text("joint1", name) + attribute_text("joint2", other) +
                attribute_text("polycoef", numbers_text(std::array{motion.offset, motion.multiplier, 0.0, 0.0, 0.0})) +
                "/>\n";
        }
    }
    return text.empty() ? "" : "  <equality>\n" + text + "  </equality>\n";
}

/// Returns the <contact>. MuJoCo leaves out neighbours but for children of the fixed base, so every pair is listed.
std::string contact_text(const SphereModel& model) {
    std::string text;
    for (const IgnoredPair& pair : model.ignored_pairs.value_or(std::vector<IgnoredPair>{})) {
        if (pair.first != world && pair.second != world) { // excluding the world does nothing
            text += "    " + exclude_text(pair) + "\n";
        }
    }
    return text.empty() ? "" : "  <contact>\n" + text + "  </contact>\n";
}

/// Returns the MJCF that the robot was read from; nothing for another robot.
std::optional<TextFile> own_text(const SphereModel& model) {
    if (!model.robot || xml::root_name(model.robot->source) != "mujoco") {
        return {};
    }
    return TextFile{model.robot->file, model.robot->source};
}

} // namespace

MjcfWriter::MjcfWriter(const Parameters& parameters)
    : free_(parameters.text("base") == "free"), density_(parameters.number("density")),
      replaces_collision_(parameters.boolean("collision")), pairs_(pair_edit(parameters)) {
    known_.ellipsoids = true;
    known_.segments = segments_of(parameters, "write.mjcf");
}

std::string MjcfWriter::write(const SphereModel& model, Context& context) const {
    if (model.into) {
        return with_spheres(*model.into, in_known_kinds(elements_by_link(model), known_),
                            {.all_collision = replaces_collision_, .pairs = pairs_, .found = model.ignored_pairs},
                            context);
    }
    if (const auto own = own_text(model)) {
        return with_provenance(with_spheres(*own, in_known_kinds(elements_by_link(model), known_),
                                            {.all_collision = true,
                                             .pairs = pairs_,
                                             .found = model.ignored_pairs,
                                             .emptied = model.without_collision,
                                             .folder = model.folder},
                                            context),
                               model);
    }
    if (!model.robot || (model.robot->joints.empty() && model.robot->links.size() > 1)) { // names of links, no tree
        require_robot(model, "write.mjcf");
    }
    const std::string name = model.robot->name.empty() ? model.name : model.robot->name;
    Bodies bodies(model, known_, free_, density_, context);
    const std::string tree = bodies.text();
    return comment_text(model.provenance) + "<mujoco" + attribute_text("model", name) + ">\n" +
           "  <compiler angle=\"radian\" autolimits=\"true\"/>\n"
           "  <default>\n"
           "    <default class=\"sphere\"><geom type=\"sphere\" group=\"3\" mass=\"0\" contype=\"1\" "
           "conaffinity=\"1\"/></default>\n" +
           (bodies.has_shaped() ? "    <default class=\"element\"><geom group=\"3\" mass=\"0\" contype=\"1\" "
                                  "conaffinity=\"1\"/></default>\n"
                                : "") +
           "  </default>\n" + bodies.assets() + "  <worldbody>\n" + tree + "  </worldbody>\n" + equality_text(model) +
           contact_text(model) + bodies.keyframe() + "</mujoco>\n";
}

std::map<std::string, Elements> MjcfWriter::read(const std::string& bytes,
                                                 const std::map<std::string, std::string>&) const {
    try {
        QuietContext context;
        return elements_of(MjcfReader().read(bytes, "MJCF", context));
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
}

} // namespace foam::xml_models
