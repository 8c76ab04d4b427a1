// How the spheres of a robot are shared out by runs: numbers, excess, protrusion, weights.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

#include <foam/geometry/volumes.hpp>

namespace foam {
namespace {

using ::testing::HasSubstr;

TEST_F(Run, MoreSpheresForTheRobotNeverClaimMore) {
    write_file(folder.path() / "arm.urdf", R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision></link>
  <link name="bracket">
    <collision><geometry><box size="0.3 0.05 0.1"/></geometry></collision>
    <collision><origin xyz="0.125 0.1 0"/><geometry><box size="0.05 0.2 0.1"/></geometry></collision>
  </link>
  <link name="pole"><collision><geometry><cylinder radius="0.05" length="0.5"/></geometry></collision></link>
  <link name="left"><collision><geometry><box size="0.02 0.03 0.15"/></geometry></collision></link>
  <link name="right"><collision><geometry><box size="0.02 0.03 0.15"/></geometry></collision></link>
  <joint name="a" type="fixed"><parent link="base"/><child link="bracket"/></joint>
  <joint name="b" type="fixed"><parent link="bracket"/><child link="pole"/></joint>
  <joint name="c" type="fixed"><parent link="pole"/><child link="left"/></joint>
  <joint name="d" type="fixed"><parent link="pole"/><child link="right"/></joint>
</robot>
)");
    double least = std::numeric_limits<double>::infinity(), first = 0;
    for (std::size_t budget = 5; budget <= 18; ++budget) {
        Recipe arm = recipe("stages: [spherize.grid]\nlinks: {base: {max_spheres: 5}}\nbudget: {spheres: " +
                            std::to_string(budget) + "}\n");
        arm.urdf = {"arm.urdf"};
        const RunResult result = run(arm, registry, options());
        EXPECT_TRUE(result.certified);
        double claimed = 0;
        for (const auto& [link, spheres] :
             test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf"))) {
            EXPECT_LE(spheres.size(), link == "base" ? 5u : budget);
            claimed += exact_union_volume(spheres);
        }
        // What is written is rounded to about a millionth of a link's size.
        EXPECT_LE(claimed, least * (1 + 1e-5)) << budget;
        least = std::min(least, claimed);
        first = std::max(first, claimed);
    }
    EXPECT_LT(least, 0.6 * first);
}

/// Between 16, 32 and 64 spheres the runtime adds spheres one by one, unless the spherizer gains much by itself.
TEST_F(Run, MoreSpheresForOneLinkNeverClaimMore) {
    RunOptions cached = options(); // the runs ask for the same numbers of spheres again and again
    cached.fresh = false;
    cached.cache = folder.path() / "cache";
    for (const std::string stage : {"spherize.grid", "spherize.octree", "spherize.cover: {effort: fast}"}) {
        SCOPED_TRACE(stage);
        double least = std::numeric_limits<double>::infinity(), error = 0;
        for (const std::size_t most : {8, 11, 12, 13, 15, 16, 17, 23, 24, 31, 32, 33, 47, 48, 62, 63, 64}) {
            const RunResult result = run(recipe("stages: [" + stage + ", refine.split]\nlinks: {tip: {skip: true}}\n" +
                                                "budget: {spheres: " + std::to_string(most) + "}\n"),
                                         registry, cached);
            EXPECT_LE(result.total.spheres, most);
            EXPECT_LE(result.total.excess, least + 1e-5 + 4 * (error + result.total.excess_error)) << most;
            least = std::min(least, result.total.excess);
            error = result.total.excess_error;
        }
    }
}

TEST_F(Run, TheFewestSpheresForAnExcess) {
    const auto made = [&](const std::string& budget) {
        return run(recipe("stages: [spherize.grid]\nbudget: " + budget + "\n"), registry, options());
    };
    const RunResult enough = made("{excess: 0.8}");
    EXPECT_TRUE(enough.certified);
    EXPECT_LE(enough.total.excess, 0.8 + 4 * enough.total.excess_error);
    EXPECT_THAT(warnings_of(enough), ::testing::IsEmpty());
    const std::size_t count = enough.total.spheres;
    EXPECT_GT(made("{spheres: " + std::to_string(count - 1) + "}").total.excess, 0.8) << "one less is not enough";

    EXPECT_EQ(made("{excess: 0.8, spheres: 100}").total.spheres, count) << "no more than are enough";
    const RunResult limited = made("{excess: 0.8, spheres: " + std::to_string(count - 1) + "}");
    EXPECT_LT(limited.total.spheres, count);
    ASSERT_EQ(warnings_of(limited).size(), 1u);
    EXPECT_THAT(
        warnings_of(limited)[0],
        ::testing::MatchesRegex(": budget\\.excess: 0\\.8 is not reached: with [0-9]+ spheres it is 0\\.[89][0-9]*; "
                                "remedy: raise budget\\.spheres"));
}

TEST_F(Run, AnExcessOutOfReachTakesTheLeastThereIs) {
    const RunResult result =
        run(recipe("stages: [spherize.grid]\nlinks: {\"*\": {max_spheres: 3}}\nbudget: {excess: 0.001}\n"), registry,
            options());
    EXPECT_TRUE(result.certified);
    EXPECT_LE(result.total.spheres, 6u);
    ASSERT_EQ(warnings_of(result).size(), 1u);
    EXPECT_THAT(warnings_of(result)[0], HasSubstr("budget.excess: 0.001 is not reached: with "));
    EXPECT_THAT(warnings_of(result)[0], HasSubstr("; remedy: raise max_spheres of the links"));
}

TEST_F(Run, TheFewestSpheresForTheExcessOfOneLink) {
    // Between two rungs of the counts that a robot's links are explored at.
    const auto made = [&](const std::string& budget) {
        return run(recipe("stages: [spherize.grid]\nlinks: {tip: {skip: true}}\nbudget: " + budget + "\n"), registry,
                   options());
    };
    const RunResult enough = made("{excess: 0.42}");
    EXPECT_GT(enough.total.spheres, 8u);
    EXPECT_LE(enough.total.excess, 0.42 + 4 * enough.total.excess_error);
    EXPECT_GT(made("{spheres: " + std::to_string(enough.total.spheres - 1) + "}").total.excess,
              0.42 - 4 * enough.total.excess_error);
    EXPECT_EQ(made("{excess: 0.42, spheres: " + std::to_string(enough.total.spheres) + "}").total.spheres,
              enough.total.spheres);
}

TEST_F(Run, ASpherizerMayFailWhereTheFewestAreLookedFor) {
    write_file(folder.path() / "two.urdf", "<robot name=\"rod\"><link name=\"base\"><collision><geometry><box "
                                           "size=\"2 0.1 0.1\"/></geometry></collision></link></robot>");
    const std::string chain = "stages: [spherize.misbehaving: {how: odd, link: base}]\n";
    const auto excess = [&](const std::string& count) {
        return run(recipe(chain + "budget: {spheres: " + count + "}\n"), registry, options()).total.excess;
    };
    const double between = 0.5 * (excess("8") + excess("10")); // so that 9 is asked for
    EXPECT_EQ(failure(chain + "budget: {excess: " + std::to_string(between) + "}\n"),
              "stage 'spherize.misbehaving', link 'base', input 'box': this number is not to my taste");
}

TEST_F(Run, NoExcessOfASurface) {
    write_file(folder.path() / "two.urdf", "<robot name=\"two\"><link name=\"sheet\"><collision><geometry><mesh "
                                           "filename=\"sheet.obj\"/></geometry></collision></link></robot>");
    write_file(folder.path() / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(failure("stages: [spherize.grid]\nbudget: {excess: 0.5}\n"),
              "budget.excess: the geometry has no volume to compare with; remedy: budget: {spheres: …} or "
              "{max_protrusion: …}");
    EXPECT_EQ(code, ErrorCode::recipe);
}

TEST_F(Run, AWeightDrawsSpheres) {
    const auto spheres_of_tip = [&](const std::string& links) {
        run(recipe("stages: [spherize.grid]\nbudget: {spheres: 12}\n" + links), registry, options());
        return test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf")).at("tip").size();
    };
    const std::size_t even = spheres_of_tip("");
    EXPECT_GT(spheres_of_tip("links: {tip: {weight: 100}}\n"), even);
    EXPECT_EQ(spheres_of_tip("links: {\"*\": {weight: 100}}\n"), even) << "the same for all";
    EXPECT_EQ(spheres_of_tip("links: {\"*\": {weight: 100}, tip: {weight: 0}}\n"), 1u) << "the later one wins";
}

TEST_F(Run, ALinkThatMayProtrudeLessGetsMoreSpheres) {
    const auto made = [&](const std::string& base) {
        return run(
            recipe("stages: [spherize.grid]\nbudget: {spheres: 16}\nlinks: {tip: {weight: 1000, max_spheres: 12}" +
                   base + "}\n"),
            registry, options());
    };
    const auto base = [](const RunResult& result) -> const Measures& { return result.links.at(0).measures; };
    const RunResult free = made("");
    EXPECT_GT(base(free).protrusion_max, 0.061);
    const RunResult tight = made(", base: {max_protrusion: 0.06}");
    EXPECT_TRUE(tight.certified);
    EXPECT_LE(base(tight).protrusion_max, 0.061);
    EXPECT_GT(base(tight).spheres, base(free).spheres);
    EXPECT_LE(tight.total.spheres, 16u);
    EXPECT_THAT(warnings_of(tight), ::testing::Not(::testing::Contains(HasSubstr("max_protrusion"))));

    const RunResult tighter = made(", base: {max_protrusion: 0.001}");
    EXPECT_LE(tighter.total.spheres, 16u);
    EXPECT_THAT(warnings_of(tighter),
                ::testing::Contains(::testing::MatchesRegex(
                    "base: its spheres \\([0-9]+\\) protrude by 0\\.0[0-9]+ m, max_protrusion allows 0\\.001 m; "
                    "remedy: more spheres for the robot or for this link")));
}

TEST_F(Run, AProtrusionOfOneLinkWithoutABudget) {
    const RunResult without = run(recipe("stages: [spherize.grid]\n"), registry, options());
    const double limit = 0.06;
    const RunResult result =
        run(recipe("stages: [spherize.grid]\nlinks: {base: {max_protrusion: 0.06}}\n"), registry, options());
    EXPECT_LE(result.links.at(0).measures.protrusion_max, limit * 1.02);
    EXPECT_EQ(result.links.at(1).measures.spheres, without.links.at(1).measures.spheres);
    const RunResult unreachable =
        run(recipe("stages: [spherize.grid]\nlinks: {base: {max_protrusion: 0.01, max_spheres: 4}}\n"), registry,
            options());
    EXPECT_EQ(warnings_of(unreachable), std::vector<std::string>{"base: 4 spheres still protrude by more than 0.01 m"});
}

TEST_F(Run, ASphereStaysOneSphereWhateverTheSpherizer) {
    write_file(folder.path() / "ball.urdf", R"(<?xml version="1.0"?>
<robot name="ball">
  <link name="ball"><collision><origin xyz="0.1 0.2 0.3"/><geometry><sphere radius="0.05"/></geometry></collision></link>
</robot>
)");
    for (const std::string name : {"grid", "voxel"}) {
        Recipe ball = recipe("stages: [spherize." + name + "]\nbudget: {spheres: 8}\n");
        ball.urdf = {"ball.urdf"};
        run(ball, registry, options());
        const auto spheres =
            test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf")).at("ball");
        ASSERT_EQ(spheres.size(), 1u);
        EXPECT_NEAR(distance(spheres[0].center, {0.1, 0.2, 0.3}), 0, 1e-9);
        EXPECT_NEAR(spheres[0].radius, 0.05, 1e-6);
        EXPECT_GE(spheres[0].radius, 0.05);
    }
}

TEST_F(Run, ACylinderTakesTheRowOfSpheresWhereItClaimsLess) {
    write_file(folder.path() / "pole.urdf", R"(<?xml version="1.0"?>
<robot name="pole">
  <link name="pole"><collision><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/>
    <geometry><cylinder radius="0.05" length="1"/></geometry></collision></link>
</robot>
)");
    Recipe pole = recipe("stages: [spherize.voxel, refine.row]\nlinks: {pole: {max_spheres: 10}}\n");
    pole.urdf = {"pole.urdf"};
    const RunResult result = run(pole, registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.total.spheres, 10u);
    const auto spheres =
        test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf")).at("pole");
    for (const Sphere& sphere : spheres) {
        EXPECT_NEAR(sphere.radius, std::hypot(0.05, 0.05), 3e-4);
    }
}

TEST_F(Run, ABudgetBelowOneSphereALinkIsRefused) {
    EXPECT_THAT(failure("stages: [spherize.grid]\nbudget: {spheres: 1}\n"),
                HasSubstr("budget.spheres: 1 is not enough"));
    EXPECT_EQ(code, ErrorCode::recipe);
}

} // namespace
} // namespace foam
