// What the tests of load.sdf share.
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
inline Robot load_sdf(const std::string& text, Context& context, const std::filesystem::path& file = "/none/robot.sdf") {
    Registry registry;
    registry.load(std::string(FOAM_TEST_PLUGINS) + "/load_mesh.so");
    const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + "/load_sdf.so");
    EXPECT_TRUE(record.loaded()) << record.rejection;
    return registry.make<RobotLoader>("load.sdf")->load(text, file, ResourceResolver{}, context);
}

inline Robot load_sdf(const std::string& text) {
    QuietContext context;
    return load_sdf(text, context);
}

/// An SDF with this content.
inline std::string sdf(const std::string& content) {
    return "<sdf version='1.9'>" + content + "</sdf>";
}

inline std::string model(const std::string& content) {
    return sdf("<model name='m'>" + content + "</model>");
}

/// A link with a ball of 1 m.
inline std::string link(const std::string& name, const std::string& more = "") {
    return "<link name='" + name + "'>" + more +
           "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision></link>";
}

inline std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const std::string& more = "") {
    return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" +
           more + "</joint>";
}

inline void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

/// A tetrahedron with corners at the origin and on the axes, at 1, 2 and 3.
inline const std::string tetrahedron_obj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

} // namespace foam::test
