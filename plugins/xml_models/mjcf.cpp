// The traps of MuJoCo's parser are named where they are met; docs: doc/XMLreference.rst (a7255075b0).
#include "mjcf.hpp"

#include "mjcf_bodies.hpp"
#include "mjcf_joints.hpp"
#include "mjcf_visuals.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

namespace foam::xml_models {
namespace {

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

/// Returns whether the file is made of the robot, not of a text.
bool is_whole(const SphereModel& model) {
    return !model.into && !own_text(model);
}

/// Throws Error(output) for names of links without a tree.
void require_tree(const SphereModel& model) {
    if (!model.robot || (model.robot->joints.empty() && model.robot->links.size() > 1)) {
        require_robot(model, "write.mjcf");
    }
}

/// Returns the <default> of the classes: collision geometry in group 3 and visual geometry in group 2, as in MuJoCo
/// Menagerie.
std::string default_text(bool shaped, const MjcfVisuals& visuals) {
    std::string text = "  <default>\n"
                       "    <default class=\"sphere\"><geom type=\"sphere\" group=\"3\" mass=\"0\" contype=\"1\" "
                       "conaffinity=\"1\"/></default>\n";
    text += shaped ? "    <default class=\"element\"><geom group=\"3\" mass=\"0\" contype=\"1\" "
                     "conaffinity=\"1\"/></default>\n"
                   : "";
    if (!visuals.empty()) { // meshes as shells: they need not be closed, nor have a volume
        text += std::string("    <default class=\"visual\">") +
                (visuals.assets().empty() ? "" : "<mesh inertia=\"shell\"/>") +
                "<geom group=\"2\" mass=\"0\" contype=\"0\" conaffinity=\"0\"/></default>\n";
    }
    return text + "  </default>\n";
}

/// Returns the <asset> with the meshes; empty without meshes.
std::string asset_text(const std::vector<std::string>& hulls, const MjcfVisuals& visuals) {
    std::string text;
    for (const auto* meshes : {&hulls, &visuals.assets()}) {
        for (const std::string& mesh : *meshes) {
            text += "    " + mesh + "\n";
        }
    }
    return text.empty() ? "" : "  <asset>\n" + text + "  </asset>\n";
}

} // namespace

MjcfWriter::MjcfWriter(const Parameters& parameters, const StageMaker& maker)
    : free_(parameters.text("base") == "free"), density_(parameters.number("density")),
      replaces_collision_(parameters.boolean("collision")), pairs_(pair_edit(parameters)),
      visuals_(parameters.boolean("visuals")), actuators_(actuators_named(parameters.text("actuators"))),
      meshes_(maker.make<MeshLoader>("load.mesh")) {
    known_.ellipsoids = true;
    known_.segments = segments_of(parameters, "write.mjcf");
    known_.engine = engine_of(parameters);
}

MjcfWriter::~MjcfWriter() = default;

std::string MjcfWriter::write(const SphereModel& model, Context& context) const {
    if (model.into) {
        return with_spheres(*model.into, in_known_kinds(elements_by_link(model), known_),
                            {.all_collision = replaces_collision_,
                             .pairs = pairs_,
                             .found = model.ignored_pairs,
                             .folder = model.folder},
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
    return whole_text(model, context);
}

std::string MjcfWriter::whole_text(const SphereModel& model, Context& context) const {
    require_tree(model);
    const std::string name = model.robot->name.empty() ? model.name : model.robot->name;
    const MjcfVisuals visuals(model, visuals_, meshes_.get(), context);
    MjcfBodies bodies(model, known_, free_, density_, visuals, context);
    const std::string tree = bodies.text();
    const std::string actuators =
        actuators_ == Actuators::none ? "" : actuator_text(bodies.driven(), actuators_, context);
    const bool servos = actuators_ == Actuators::position || actuators_ == Actuators::velocity;
    visuals.report(context);
    return comment_text(model.provenance) + "<mujoco" + attribute_text("model", name) + ">\n" +
           "  <compiler angle=\"radian\" autolimits=\"true\"/>\n" +
           (servos ? "  <option integrator=\"implicitfast\"/>\n" : "") + // stiff servos of light links need it
           default_text(bodies.has_shaped(), visuals) + asset_text(bodies.meshes(), visuals) + "  <worldbody>\n" +
           tree + "  </worldbody>\n" + equality_text(model) + contact_text(model) + actuators +
           bodies.keyframe(actuators_ == Actuators::position) + "</mujoco>\n";
}

std::map<std::string, std::string> MjcfWriter::files_beside(const SphereModel& model, Context&) const {
    if (!is_whole(model) || !visuals_) {
        return {};
    }
    require_tree(model);
    QuietContext quiet; // write() has logged it
    return MjcfVisuals(model, visuals_, meshes_.get(), quiet).files();
}

std::map<std::string, Elements> MjcfWriter::read(const std::string& bytes,
                                                 const std::map<std::string, std::string>&) const {
    try {
        QuietContext context;
        return held_by(known_.engine, elements_of(MjcfReader().read(bytes, "MJCF", context)));
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
}

} // namespace foam::xml_models
