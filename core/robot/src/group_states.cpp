#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/robot.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <optional>

namespace foam::inline robot {
namespace {

/// Adds the position of a <joint>; of a joint of several freedoms nothing.
void add_position(const xml::Element& joint, const std::string& file, JointValues& values) {
    const std::string *name = joint.attribute("name"), *text = joint.attribute("value");
    const std::vector<std::string_view> numbers = text ? words(*text) : std::vector<std::string_view>{};
    const std::optional<double> value = numbers.empty() ? std::nullopt : parse_number(numbers.front());
    if (!name || !value) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: a <joint> of a <group_state> needs a name and one number as "
                                                  "value",
                                                  file, joint.line));
    }
    if (numbers.size() == 1) {
        values[*name] = *value;
    }
}

/// A joint of an MJCF and how many numbers of qpos it takes.
struct Coordinate {
    std::string joint;
    std::size_t numbers = 1;
};

/// Adds the joints of a body and of those below it, in the order of qpos: depth first, as they stand.
void add_coordinates(const xml::Element& body, std::vector<Coordinate>& coordinates) {
    for (const auto& child : body.children) {
        if (child->name == "freejoint") {
            coordinates.push_back({"", 7});
        } else if (child->name == "joint") {
            const std::string *name = child->attribute("name"), *type = child->attribute("type");
            const std::size_t numbers = type && *type == "free" ? 7 : type && *type == "ball" ? 4 : 1;
            coordinates.push_back({name ? *name : "", numbers});
        }
    }
    for (const xml::Element* child : body.children_named("body")) {
        add_coordinates(*child, coordinates);
    }
}

/// Returns the pose of a <key>; nothing if its numbers are not those of the joints.
std::optional<GroupState> pose_of_key(const xml::Element& key, const std::vector<Coordinate>& coordinates) {
    const std::string *name = key.attribute("name"), *qpos = key.attribute("qpos");
    GroupState pose{name ? *name : "", {}};
    const std::vector<std::string_view> numbers = qpos ? words(*qpos) : std::vector<std::string_view>{};
    std::size_t at = 0;
    for (const auto& [joint, count] : coordinates) {
        const auto value = at < numbers.size() ? parse_number(numbers[at]) : std::nullopt;
        if (value && count == 1 && !joint.empty()) {
            pose.values[joint] = *value;
        }
        at += count;
    }
    return at == numbers.size() && at > 0 ? std::optional(std::move(pose)) : std::nullopt;
}

/// Returns the keyframes of an MJCF: <key qpos="...">. One whose numbers are not those of the joints is left out, as is
/// any file whose joints stand in other files.
std::vector<GroupState> keyframes(const xml::Element& mujoco) {
    std::vector<Coordinate> coordinates;
    for (const xml::Element* world : mujoco.children_named("worldbody")) {
        add_coordinates(*world, coordinates);
    }
    std::vector<GroupState> poses;
    for (const xml::Element* keys : mujoco.children_named("keyframe")) {
        for (const xml::Element* key : keys->children_named("key")) {
            if (auto pose = pose_of_key(*key, coordinates)) {
                poses.push_back(std::move(*pose));
            }
        }
    }
    return poses;
}

} // namespace

std::vector<GroupState> group_states(const std::string& text, const std::string& file) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (begin == text.npos || text[begin] != '<') {
        return {};
    }
    const auto root = xml::parse(text, file, ErrorCode::input);
    std::vector<GroupState> poses;
    if (root->name != "robot") {
        return root->name == "mujoco" ? keyframes(*root) : poses;
    }
    for (const xml::Element* state : root->children_named("group_state")) {
        const std::string* name = state->attribute("name");
        GroupState& pose = poses.emplace_back(GroupState{name ? *name : "", {}});
        for (const xml::Element* joint : state->children_named("joint")) {
            add_position(*joint, file, pose.values);
        }
    }
    return poses;
}

} // namespace foam::robot
