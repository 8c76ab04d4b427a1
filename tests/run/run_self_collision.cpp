// Runs that keep the spheres of links apart.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

namespace foam {
namespace {

using ::testing::HasSubstr;

/// A tool over a table that carries its arm: 4 cm apart at zero, flat on it at -0.04.
constexpr const char* tool_over_table = R"(<?xml version="1.0"?>
<robot name="table">
  <link name="table"><collision><geometry><box size="0.4 0.4 0.1"/></geometry></collision></link>
  <link name="arm"><collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.01" length="0.1"/></geometry></collision></link>
  <link name="tool"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="continuous"><origin xyz="0.3 0 0.05"/><parent link="table"/><child link="arm"/></joint>
  <joint name="slide" type="prismatic">
    <origin xyz="-0.3 0 0.09"/><axis xyz="0 0 1"/><limit lower="-0.1" upper="0.1" effort="1" velocity="1"/>
    <parent link="arm"/><child link="tool"/>
  </joint>
</robot>
)";

TEST_F(Run, SpheresOfLinksThatAreApartStayApart) {
    write_file(folder.path() / "two.urdf", tool_over_table);
    const auto made = [&](const std::string& rest) {
        return run(recipe("stages: [spherize.grid]\nlinks: {table: {weight: 0.1}, tool: {weight: 0.01}}\n" + rest),
                   registry, options());
    };
    const auto overlap = [&] {
        const auto spheres = test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf"));
        double deepest = 0;
        for (const Sphere& a : spheres.at("table")) {
            for (const Sphere& b : spheres.at("tool")) {
                deepest = std::max(deepest, a.radius + b.radius - distance(a.center, b.center + Vec3{0, 0, 0.14}));
            }
        }
        return deepest;
    };
    made("budget: {spheres: 60}\n");
    EXPECT_GT(overlap(), 0);
    const RunResult apart = made("budget: {spheres: 60}\nself_collision: true\n");
    EXPECT_EQ(overlap(), 0);
    EXPECT_TRUE(apart.certified);
    EXPECT_LE(apart.total.spheres, 60u);
    EXPECT_THAT(warnings_of(apart), ::testing::Not(::testing::Contains(HasSubstr("overlap"))));

    const RunResult few = made("budget: {spheres: 4}\nself_collision: true\n");
    EXPECT_GT(overlap(), 0);
    EXPECT_THAT(warnings_of(few),
                ::testing::Contains(::testing::MatchesRegex(
                    "table: its spheres overlap those of tool by 0\\.[0-9]+ m in the pose of self_collision, although "
                    "the geometry of the two links does not touch; remedy: more spheres for both, or max_protrusion")));
    // Where the geometry touches, spheres that cover it must.
    const RunResult touching = made("budget: {spheres: 4}\nself_collision: {pose: {slide: -0.04}}\n");
    EXPECT_THAT(warnings_of(touching), ::testing::Not(::testing::Contains(HasSubstr("overlap"))));
    EXPECT_THAT(failure("stages: [spherize.grid]\nself_collision: {pose: {knee: 1}}\n"),
                HasSubstr("error[unknown-joint]: 'knee' in 'self_collision.pose' names no joint of "));
    EXPECT_EQ(code, ErrorCode::recipe);
}

} // namespace
} // namespace foam
