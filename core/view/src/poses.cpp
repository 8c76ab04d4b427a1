#include "poses.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline view {
namespace {

NamedPose group_state(const xml::Element& element, const Kinematics& kinematics, const std::string& file) {
    const std::string* name = element.attribute("name");
    NamedPose pose{name ? *name : "", kinematics.configuration()};
    for (const xml::Element* joint : element.children_named("joint")) {
        const std::string *which = joint->attribute("name"), *text = joint->attribute("value");
        const std::optional<double> value = text ? parse_number(*text) : std::nullopt;
        if (!which || !value) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: a <joint> of a <group_state> needs a name and one number "
                                                      "as value",
                                                      file, joint->line));
        }
        const auto& freedoms = kinematics.freedoms();
        const auto freedom =
            std::find_if(freedoms.begin(), freedoms.end(), [&](const Freedom& f) { return f.joint == *which; });
        if (freedom != freedoms.end()) { // others are fixed, or of another robot's version
            pose.configuration[static_cast<std::size_t>(freedom - freedoms.begin())] = *value;
        }
    }
    return pose;
}

} // namespace

std::vector<NamedPose> named_poses(const Kinematics& kinematics, const std::filesystem::path& srdf) {
    std::vector<NamedPose> poses{{"zero", kinematics.configuration()}, {"middle", {}}};
    for (const Freedom& freedom : kinematics.freedoms()) {
        poses.back().configuration.push_back((freedom.lower + freedom.upper) / 2);
    }
    if (srdf.empty()) {
        return poses;
    }
    const std::string text = read_file(srdf, most_robot_bytes);
    const auto root = xml::parse(text, srdf.string(), ErrorCode::input);
    for (const xml::Element* state : root->children_named("group_state")) {
        poses.push_back(group_state(*state, kinematics, srdf.string()));
    }
    return poses;
}

} // namespace foam::inline view
