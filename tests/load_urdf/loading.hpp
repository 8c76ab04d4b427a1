// What the tests of load.urdf share.
#pragma once

#include "support/listening_context.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace foam::test {

inline std::unique_ptr<RobotLoader> urdf_loader(Registry& registry) {
    const PluginRecord& record = registry.load(FOAM_TEST_PLUGINS "/load_urdf.so");
    EXPECT_TRUE(record.loaded()) << record.rejection;
    return registry.make<RobotLoader>("load.urdf");
}

/// A robot from text, as if it stood in `file`.
inline Robot load_text(const std::string& text, Context& context,
                       const std::filesystem::path& file = "/none/robot.urdf",
                       const ResourceResolver& resources = ResourceResolver{}) {
    Registry registry;
    return urdf_loader(registry)->load(text, file, resources, context);
}

inline Robot load_text(const std::string& text) {
    QuietContext context;
    return load_text(text, context);
}

} // namespace foam::test
