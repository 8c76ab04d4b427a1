// placed_spheres URDF TABLE: puts spheres on the links of a robot, writes them as a table for `foam convert`, and
// prints as JSON what a consumer must find: links, spheres, and their centres at three joint positions.
#include "robots.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>

namespace foam::test {
namespace {

using nlohmann::json;

json numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
}

json description(const SphereModel& model) {
    json result = {{"file", model.robot->file},
                   {"links", json::array()},
                   {"spheres", json::object()},
                   {"positions", json::array()}};
    for (const Link& link : model.robot->links) {
        result["links"].push_back(link.name);
    }
    for (const SphereGroup& group : model.groups) {
        for (const Sphere& s : group.tree.finest()) {
            result["spheres"][group.link].push_back({s.center.x, s.center.y, s.center.z, s.radius});
        }
    }
    const Kinematics kinematics(model.robot);
    for (const std::vector<double>& configuration : configurations(kinematics)) {
        json position = {{"joints", json::object()}, {"centers", json::object()}};
        for (const auto& [joint, value] : joint_values(kinematics, configuration)) {
            position["joints"][joint] = value;
        }
        for (const auto& [link, spheres] : placed(model, kinematics, configuration)) {
            for (const Sphere& s : spheres) {
                position["centers"][link].push_back(numbers(s.center));
            }
        }
        result["positions"].push_back(position);
    }
    return result;
}

} // namespace
} // namespace foam::test

int main(int count, char** arguments) {
    using namespace foam;
    if (count != 3) {
        std::fputs("usage: placed_spheres URDF TABLE\n", stderr);
        return 2;
    }
    const SphereModel model = test::spheres_on(test::robot_of(std::filesystem::path(arguments[1])));
    QuietContext context;
    std::ofstream(arguments[2]) << test::writer("write_csv", "write.csv")->write(model, context);
    std::printf("%s\n", test::description(model).dump().c_str());
}
