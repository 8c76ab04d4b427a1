#include "tree_writer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam::tree {

using yaml::Value;

Value spheres_of_links(const std::vector<LinkSpheres>& links) {
    Value map = yaml::map();
    for (const LinkSpheres& link : links) {
        Value list = yaml::list();
        for (const Sphere& s : link.elements.spheres()) {
            list.items.push_back(yaml::map(
                {{"center", yaml::list({s.center.x, s.center.y, s.center.z})}, {"radius", yaml::real(s.radius)}}));
        }
        yaml::append(map, link.link, std::move(list));
    }
    return map;
}

Value ignored_links(const std::vector<IgnoredPair>& pairs) {
    Value map = yaml::map();
    for (const IgnoredPair& pair : pairs) {
        if (!map.find(pair.first)) {
            yaml::append(map, pair.first, yaml::list());
        }
        const auto at = std::find_if(map.keys.begin(), map.keys.end(),
                                     [&](const yaml::Key& key) { return key.text == pair.first; });
        map.items[static_cast<std::size_t>(at - map.keys.begin())].items.push_back(yaml::text(pair.second));
    }
    return map;
}

Value names_of(const PlannedJoints::Positions& joints) {
    Value list = yaml::list();
    for (const auto& [joint, position] : joints) {
        list.items.push_back(yaml::text(joint));
    }
    return list;
}

Value positions_of(const PlannedJoints::Positions& joints) {
    Value list = yaml::list();
    for (const auto& [joint, position] : joints) {
        list.items.push_back(yaml::real(position));
    }
    return list;
}

Value map_of(const PlannedJoints::Positions& joints) {
    Value map = yaml::map();
    for (const auto& [joint, position] : joints) {
        yaml::append(map, joint, yaml::real(position));
    }
    return map;
}

Value repeated(double value, std::size_t count) {
    return yaml::list(std::vector<double>(count, value));
}

std::string urdf_path(const SphereModel& model, Context& context) {
    namespace fs = std::filesystem;
    const Robot& robot = *model.robot;
    const fs::path file = robot.file.empty() ? model.folder / (robot.name + ".urdf") : robot.file;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        context.log(Severity::warning, fmt::format("the URDF that the file refers to is not there: {}; remedy: put it "
                                                   "there, or correct urdf_path in the file",
                                                   shown(file.string())));
    }
    return model.folder.empty() ? file.filename().string() : fs::absolute(file).lexically_normal().string();
}

void require_below_base(const SphereModel& model, const std::vector<LinkSpheres>& links, const std::string& writer) {
    std::map<std::string, std::string> parents;
    for (const Joint& joint : model.robot->joints) {
        parents[joint.child] = joint.parent;
    }
    for (const LinkSpheres& link : links) {
        std::string at = link.link;
        while (at != base_link(model) && parents.contains(at)) {
            at = parents.at(at);
        }
        if (at != base_link(model)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: link '{}' has spheres, but is not below the base link '{}'; remedy: another "
                                    "base_link, or links: {{{}: {{skip: true}}}}",
                                    writer, link.link, base_link(model), link.link));
        }
    }
}

} // namespace foam::tree
