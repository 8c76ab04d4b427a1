// What the tests of load.mjcf share.
#pragma once

#include "support/listening_context.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace foam::test {

/// A robot from text, as if it stood in `file`.
inline Robot load_mjcf(const std::string& text, Context& context, const std::filesystem::path& file = "/none/robot.xml",
                       const std::map<std::string, ParameterValue>& parameters = {}) {
    Registry registry;
    for (const char* plugin : {"/load_mjcf.so", "/load_mesh.so"}) {
        const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + plugin);
        EXPECT_TRUE(record.loaded()) << record.rejection;
    }
    return registry.make<RobotLoader>("load.mjcf", parameters)->load(text, file, ResourceResolver{}, context);
}

inline Robot load_mjcf(const std::string& text) {
    QuietContext context;
    return load_mjcf(text, context);
}

/// The robot of an MJCF with these elements in its world.
inline Robot load_world(const std::string& content, const std::string& before = "") {
    return load_mjcf("<mujoco>" + before + "<worldbody>" + content + "</worldbody></mujoco>");
}

inline void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

/// A tetrahedron with corners at the origin and on the axes, at 1, 2 and 3.
inline const std::string tetrahedron_obj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

inline const Link& link_of(const Robot& robot, const std::string& name) {
    const Link* link = robot.find_link(name);
    EXPECT_NE(link, nullptr) << name;
    return *link;
}

/// Where a point of a link lies in the world, at joint values.
inline Vec3 in_world(const Robot& robot, const std::string& link, const Vec3& point, const JointValues& values = {}) {
    return link_poses(robot, values).at(link) * point;
}

inline void expect_at(const Vec3& point, const Vec3& expected) {
    EXPECT_NEAR(distance(point, expected), 0, 1e-12) << point.x << " " << point.y << " " << point.z << " is not "
                                                     << expected.x << " " << expected.y << " " << expected.z;
}

} // namespace foam::test
