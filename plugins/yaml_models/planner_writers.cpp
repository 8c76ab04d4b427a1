// Robot files of planners: cuRobo, XRDF, Lula.
#include "writers.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

namespace foam::tree {
namespace {

using yaml::Value;

Value names_of_links(const std::vector<LinkSpheres>& links) {
    Value names = yaml::list();
    for (const LinkSpheres& link : links) {
        names.items.push_back(yaml::text(link.link));
    }
    return names;
}

/// Returns all joints of a planner in the order of the URDF.
PlannedJoints::Positions in_urdf_order(const SphereModel& model, const PlannedJoints& joints) {
    PlannedJoints::Positions all;
    for (const Joint& joint : model.robot->joints) {
        for (const auto* some : {&joints.active, &joints.locked}) {
            for (const auto& entry : *some) {
                if (entry.first == joint.name) {
                    all.push_back(entry);
                }
            }
        }
    }
    return all;
}

/// Returns the pairs that need no check; none where they are not known.
std::vector<IgnoredPair> pairs_of(const SphereModel& model) {
    return model.ignored_pairs.value_or(std::vector<IgnoredPair>{});
}

void require_active_joints(const PlannedJoints& joints, const std::string& writer) {
    if (joints.active.empty()) {
        throw Error(ErrorCode::output, writer + " needs a joint that moves and is not locked; the robot has none");
    }
}

constexpr double usual_acceleration = 10, usual_jerk = 500; ///< cuRobo's defaults

} // namespace

CuroboWriter::CuroboWriter(const Parameters& parameters)
    : TreeWriter("write.curobo", read_curobo), old_(parameters.text("version") == "0.7"), pairs_(pair_edit(parameters)),
      buffer_(parameters.number("buffer")), urdf_path_(parameters.text("urdf_path")),
      asset_root_path_(parameters.text("asset_root_path")) {}

Value CuroboWriter::cspace(const SphereModel& model, const PlannedJoints& joints) const {
    const PlannedJoints::Positions all = in_urdf_order(model, joints);
    return yaml::map({{"joint_names", names_of(all)},
                      {old_ ? "retract_config" : "default_joint_position", positions_of(all)},
                      {"null_space_weight", repeated(1, all.size())},
                      {"cspace_distance_weight", repeated(1, all.size())},
                      {"max_acceleration", yaml::real(model.facts.acceleration.value_or(usual_acceleration))},
                      {"max_jerk", yaml::real(model.facts.jerk.value_or(usual_jerk))}});
}

Value CuroboWriter::document(const SphereModel& model, const std::vector<LinkSpheres>& links, Context& context) const {
    require_robot(model, name());
    const std::vector<std::string>& tools = require_tool_frames(model, name());
    require_below_base(model, links, name());
    warn_without_pairs(model, context);
    const PlannedJoints joints = planned_joints(model);
    require_active_joints(joints, name());
    const std::string urdf = urdf_path_.empty() ? urdf_path(model, context) : urdf_path_;
    Value kinematics = yaml::map();
    if (!old_) {
        yaml::append(kinematics, "format_version", yaml::real(2));
    }
    yaml::append(kinematics, "urdf_path", yaml::text(urdf));
    yaml::append(
        kinematics, "asset_root_path",
        yaml::text(asset_root_path_.empty() ? std::filesystem::path(urdf).parent_path().string() : asset_root_path_));
    yaml::append(kinematics, "base_link", yaml::text(base_link(model)));
    if (old_) {
        yaml::append(kinematics, "ee_link", yaml::text(tools.front()));
        yaml::append(kinematics, "link_names", yaml::list(tools));
    } else {
        yaml::append(kinematics, "tool_frames", yaml::list(tools));
    }
    yaml::append(kinematics, "collision_link_names", names_of_links(links));
    yaml::append(kinematics, "collision_spheres", spheres_of_links(links));
    yaml::append(kinematics, "collision_sphere_buffer", yaml::real(buffer_));
    yaml::append(kinematics, "self_collision_ignore", ignored_links(pairs_of(model)));
    yaml::append(kinematics, "self_collision_buffer", yaml::map());
    yaml::append(kinematics, "lock_joints", map_of(joints.locked));
    yaml::append(kinematics, "cspace", cspace(model, joints));
    return yaml::map({{"robot_cfg", yaml::map({{"kinematics", std::move(kinematics)}})}});
}

void CuroboWriter::edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                        Context& context) const {
    std::vector<std::string_view> at{"robot_cfg", "kinematics"};
    if (!file.find(at)) {
        at = {"kinematics"};
    }
    if (!file.find(at)) {
        fail_without_key(model, "kinematics", "give a robot file of cuRobo");
    }
    const auto set = [&](std::string_view key, const Value& value) {
        at.push_back(key);
        file.set(at, value);
        at.pop_back();
    };
    set("collision_link_names", names_of_links(links));
    set("collision_spheres", spheres_of_links(links));
    at.push_back("self_collision_ignore");
    edit_ignored_links(file, at, model, pairs_, context);
}

XrdfWriter::XrdfWriter(const Parameters& parameters)
    : TreeWriter("write.xrdf", read_xrdf), new_(parameters.text("version") == "2.0"), pairs_(pair_edit(parameters)) {}

Value XrdfWriter::document(const SphereModel& model, const std::vector<LinkSpheres>& links, Context& context) const {
    require_robot(model, name());
    const std::vector<std::string>& tools = require_tool_frames(model, name());
    require_below_base(model, links, name());
    warn_without_pairs(model, context);
    const PlannedJoints joints = planned_joints(model);
    require_active_joints(joints, name());
    const std::string group = "foam_spheres";
    Value document = yaml::map({{"format", yaml::text("xrdf")}, {"format_version", yaml::real(new_ ? 2 : 1)}});
    if (base_link(model) != model.robot->root) {
        yaml::append(document, "modifiers",
                     yaml::list({yaml::map({{"set_base_frame", yaml::text(base_link(model))}})}));
    }
    yaml::append(document, "default_joint_positions", map_of(in_urdf_order(model, joints)));
    const std::size_t count = joints.active.size();
    yaml::append(
        document, "cspace",
        yaml::map({{"joint_names", names_of(joints.active)},
                   {"acceleration_limits", repeated(model.facts.acceleration.value_or(usual_acceleration), count)},
                   {"jerk_limits", repeated(model.facts.jerk.value_or(usual_jerk), count)}}));
    yaml::append(document, "tool_frames", yaml::list(tools));
    yaml::append(document, new_ ? "world_collision" : "collision", yaml::map({{"geometry", yaml::text(group)}}));
    yaml::append(document, "self_collision",
                 yaml::map({{"geometry", yaml::text(group)}, {"ignore", ignored_links(pairs_of(model))}}));
    yaml::append(document, "geometry", yaml::map({{group, yaml::map({{"spheres", spheres_of_links(links)}})}}));
    return document;
}

void XrdfWriter::edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                      Context& context) const {
    const Value* collision = file.find({"world_collision"});
    collision = collision ? collision : file.find({"collision"});
    const Value* group = collision && collision->is(Value::Kind::map) ? collision->find("geometry") : nullptr;
    if (!group || !group->is(Value::Kind::text)) {
        fail_without_key(model, "collision.geometry", "give an XRDF file");
    }
    const std::string name = group->text;
    if (const Value* clone = file.find({"geometry", name, "clone"})) {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: geometry '{}' clones others, whose spheres would stay beside the new ones; "
                                "remedy: delete 'clone'",
                                model.into->file.string(), clone->where.line, clone->where.column, name));
    }
    if (const Value* own = file.find({"self_collision", "geometry"}); own && own->text != name) {
        context.log(Severity::warning,
                    fmt::format("{}:{}: self_collision has a geometry of its own, '{}', which stays as it is",
                                model.into->file.string(), own->where.line, own->text));
    }
    file.set({"geometry", name, "spheres"}, spheres_of_links(links));
    edit_ignored_links(file, {"self_collision", "ignore"}, model, pairs_, context);
}

LulaWriter::LulaWriter(const Parameters&) : TreeWriter("write.lula", read_collision_spheres) {}

Value LulaWriter::spheres(const std::vector<LinkSpheres>& links) {
    const Value map = spheres_of_links(links);
    Value list = yaml::list();
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
        list.items.push_back(yaml::map({{map.keys[i].text, map.items[i]}}));
    }
    return list;
}

Value LulaWriter::document(const SphereModel& model, const std::vector<LinkSpheres>& links, Context&) const {
    require_robot(model, name());
    const PlannedJoints joints = planned_joints(model);
    require_active_joints(joints, name());
    Value fixed = yaml::list();
    for (const auto& [joint, position] : joints.locked) {
        fixed.items.push_back(
            yaml::map({{"name", yaml::text(joint)}, {"rule", yaml::text("fixed")}, {"value", yaml::real(position)}}));
    }
    const std::size_t count = joints.active.size();
    Value document = yaml::map({{"api_version", yaml::real(1)},
                                {"cspace", names_of(joints.active)},
                                {"default_q", positions_of(joints.active)}});
    if (model.facts.acceleration) {
        yaml::append(document, "acceleration_limits", repeated(*model.facts.acceleration, count));
    }
    if (model.facts.jerk) {
        yaml::append(document, "jerk_limits", repeated(*model.facts.jerk, count));
    }
    yaml::append(document, "cspace_to_urdf_rules", std::move(fixed));
    yaml::append(document, "collision_spheres", spheres(links));
    return document;
}

void LulaWriter::edit(yaml::Splice& file, const SphereModel&, const std::vector<LinkSpheres>& links, Context&) const {
    file.set({"collision_spheres"}, spheres(links));
}

} // namespace foam::tree
