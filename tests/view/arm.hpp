// A small robot in a folder of its own, and sphere models of it.
#pragma once

#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/view/session.hpp>

#include <gmock/gmock.h>

namespace foam::test {

/// A base, an arm that turns, and a finger that slides; a second finger mimics it.
inline constexpr const char* arm_urdf = R"(<?xml version="1.0"?>
<robot name="arm">
  <material name="orange"><color rgba="1 0.5 0 1"/></material>
  <link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry><material name="orange"/></visual>
    <collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <link name="upper"><visual><origin xyz="0 0 0.2"/><geometry><box size="0.08 0.08 0.4"/></geometry>
      <material name="own"><color rgba="0 0 1 0.5"/></material></visual>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.08 0.08 0.4"/></geometry></collision></link>
  <link name="left"><collision><geometry><box size="0.02 0.02 0.06"/></geometry></collision></link>
  <link name="right"><collision><geometry><box size="0.02 0.02 0.06"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.06"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="open" type="prismatic"><parent link="upper"/><child link="left"/><origin xyz="0 0.01 0.45"/>
    <axis xyz="0 1 0"/><limit lower="0.01" upper="0.05" effort="1" velocity="1"/></joint>
  <joint name="follow" type="prismatic"><parent link="upper"/><child link="right"/><origin xyz="0 -0.01 0.45"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="0.05" effort="1" velocity="1"/><mimic joint="open"/></joint>
</robot>
)";

/// One ball around each box.
inline constexpr const char* arm_spheres = "link,x,y,z,radius\nbase,0,0,0,0.15001\nupper,0,0,0.2,0.20801\n"
                                           "left,0,0,0,0.0332\nright,0,0,0,0.0332\n";

class ArmTest : public RunTest {
protected:
    ArmTest() {
        write("arm.urdf", arm_urdf);
        write("arm.csv", arm_spheres);
    }

    SubjectOptions with(std::vector<std::string> names) const {
        SubjectOptions options;
        for (const std::string& name : names) {
            options.files.push_back(folder.path() / name);
        }
        return options;
    }
    Subject subject(const SubjectOptions& options) const { return load_subject(options, registry); }

    /// The message of the Error that `body` throws; empty if it throws none.
    template <class Body> static std::string refusal(Body body) {
        try {
            body();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
};

} // namespace foam::test
