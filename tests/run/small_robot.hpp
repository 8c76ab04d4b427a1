// Runs on a robot of two links, a box and a cylinder.
#pragma once

#include "run/files.hpp"
#include "support/temporary_folder.hpp"

#include <foam/error.hpp>
#include <foam/host/run.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foam {

inline constexpr const char* two_links = R"(<?xml version="1.0"?>
<robot name="two">
  <!-- the base -->
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.2 0.2"/></geometry></collision></link>
  <link name="tip"><collision><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
  <joint name="j" type="fixed"><origin xyz="0 0 0.3"/><parent link="base"/><child link="tip"/></joint>
</robot>
)";

class Run : public ::testing::Test {
protected:
    Run() {
        registry.load_directory(FOAM_TEST_PLUGINS);
        registry.load(FOAM_TEST_MISBEHAVING);
        write_file(folder.path() / "two.urdf", two_links);
    }

    /// Of the robot two.urdf; `rest`: what follows its name.
    Recipe recipe(const std::string& rest) {
        const auto result =
            parse_recipe("foam: 1\nname: two\nrobot: {urdf: two.urdf}\n" + rest, folder.path() / "two.yaml", registry);
        for (const Diagnostic& finding : result.diagnostics) {
            ADD_FAILURE() << finding.text();
        }
        return result.recipes.at(0);
    }
    RunOptions options(const std::string& out = "out") const {
        RunOptions o;
        o.out = folder.path() / out;
        o.fresh = true;
        return o;
    }
    std::string failure(const std::string& rest) {
        try {
            run(recipe(rest), registry, options());
        } catch (const Error& error) {
            code = error.code();
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder;
    Registry registry;
    ErrorCode code = ErrorCode::internal;
};

} // namespace foam
