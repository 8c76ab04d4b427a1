#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/group_states.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

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

} // namespace

std::vector<GroupState> group_states(const std::string& text, const std::string& file) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (begin == text.npos || text[begin] != '<') {
        return {};
    }
    const auto root = xml::parse(text, file, ErrorCode::input);
    std::vector<GroupState> poses;
    if (root->name != "robot") {
        return poses;
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
