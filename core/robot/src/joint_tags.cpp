#include "joint_tags.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

namespace foam::inline robot {
namespace {

[[noreturn]] void fail(const Robot& robot, const xml::Element& mimic, const std::string& what) {
    throw Error(ErrorCode::input, fmt::format("{}:{}: {}", robot.file.string(), mimic.line, what));
}

double number(const Robot& robot, const xml::Element& mimic, const char* name, double otherwise) {
    const std::string* text = mimic.attribute(name);
    if (!text) {
        return otherwise;
    }
    const std::vector<std::string_view> pieces = words(*text);
    const std::optional<double> value = pieces.size() == 1 ? parse_number(pieces.front()) : std::nullopt;
    if (!value) {
        fail(robot, mimic, fmt::format("<mimic {}>: '{}' is not a finite number", name, *text));
    }
    return *value;
}

Mimic read_mimic(const Robot& robot, const xml::Element& mimic) {
    const std::string* joint = mimic.attribute("joint");
    if (!joint) {
        fail(robot, mimic, "<mimic> does not say which joint it follows; remedy: <mimic joint=\"NAME\"/>");
    }
    return {*joint, number(robot, mimic, "multiplier", 1), number(robot, mimic, "offset", 0)};
}

/// Returns the root element; nullptr if the text is not XML.
std::unique_ptr<const xml::Element> parsed(const Robot& robot) {
    try {
        return xml::parse(robot.source, robot.file.string(), ErrorCode::input);
    } catch (const Error&) {
        return nullptr; // a robot of another format
    }
}

} // namespace

std::map<std::string, JointTags> read_joint_tags(const Robot& robot) {
    const auto root = robot.source.empty() ? nullptr : parsed(robot);
    std::map<std::string, JointTags> tags;
    if (!root || root->name != "robot") {
        return tags;
    }
    for (const xml::Element* joint : root->children_named("joint")) {
        const std::string* name = joint->attribute("name");
        if (!name) {
            continue;
        }
        JointTags& tag = tags[*name];
        tag.line = joint->line;
        tag.limited = tag.limited || joint->child("limit");
        for (const xml::Element* mimic : joint->children_named("mimic")) {
            tag.mimic = read_mimic(robot, *mimic);
        }
    }
    return tags;
}

} // namespace foam::robot
