// Whole runs on small robots: what comes out, what is said when a stage fails, what is left behind.
#include "small_robot.hpp"

#include <foam/host/verify.hpp>
#include <foam/measure.hpp>
#include <foam/union_volume.hpp>

#include <thread>

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(Run, WritesACertifiedRobotWithinItsBudget) {
    const RunResult result = run(recipe("stages: [spherize.grid]\nbudget: {spheres: 12}\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.total.spheres, 12u);
    EXPECT_EQ(result.total.gap, 0);
    const auto writer = registry.make<Writer>("write.urdf");
    const auto spheres = writer->read(read_file(folder.path() / "out/two.urdf"));
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(spheres.at("base").size() + spheres.at("tip").size(), 12u);
    for (const char* file : {"two.json", "manifest.json", "events.jsonl", "recipe.resolved.yaml"}) {
        EXPECT_TRUE(fs::exists(folder.path() / "out" / file)) << file;
    }
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<!-- the base -->"));
}

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
             registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf"))) {
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

/// Warnings and errors of a run, in their order.
std::vector<std::string> warnings_of(const RunResult& result) {
    std::vector<std::string> warnings;
    for (const Finding& finding : result.findings) {
        if (finding.severity >= Severity::warning) {
            warnings.push_back(finding.link + ": " + finding.message);
        }
    }
    return warnings;
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
        return registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf")).at("tip").size();
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
            registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf")).at("ball");
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
    Recipe pole = recipe("stages: [spherize.voxel]\nlinks: {pole: {max_spheres: 10}}\n");
    pole.urdf = {"pole.urdf"};
    const RunResult result = run(pole, registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.total.spheres, 10u);
    const auto spheres =
        registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf")).at("pole");
    for (const Sphere& sphere : spheres) {
        EXPECT_NEAR(sphere.radius, std::hypot(0.05, 0.05), 3e-4);
    }
}

TEST_F(Run, GrowsWhatASpherizerLeavesOpen) {
    const RunResult result =
        run(recipe("stages: [spherize.misbehaving: {how: small, link: base}]\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.links[0].growth, 0.1);
    EXPECT_LT(result.links[1].growth, 1e-4);
}

TEST_F(Run, FittedSpheresNeitherClaimNorMissMuch) {
    const RunResult result = run(
        recipe("stages: [spherize.misbehaving: {how: small, link: base}]\nguarantee: fitted\n"), registry, options());
    EXPECT_FALSE(result.certified);
    const Measures& base = result.links[0].measures;
    EXPECT_GT(base.gap, 0.03);
    EXPECT_LT(base.covered, 0.9);
    EXPECT_GT(base.excess, 0.05);
    EXPECT_LT(base.excess + base.missing, 0.6);
}

TEST_F(Run, InnerShrinksWhatSticksOut) {
    const RunResult result =
        run(recipe("stages: [spherize.grid]\nbudget: {spheres: 12}\nguarantee: inner\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.total.spheres, 1u);
    EXPECT_LT(result.total.missing, 0.9);
    EXPECT_NEAR(result.total.excess, 0, 1e-9);
    EXPECT_EQ(result.total.protrusion_max, 0);
    EXPECT_GT(result.total.gap, 0);
    const auto written = registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf"));
    std::size_t count = 0;
    for (const auto& [link, spheres] : written) {
        count += spheres.size();
    }
    EXPECT_EQ(count, result.total.spheres);
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"guarantee\": \"inner\""));
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"certified\": true"));
}

TEST_F(Run, InnerSaysWhereNothingIsLeft) {
    const std::string stages = "stages: [spherize.misbehaving: {how: outside, link: tip}]\nguarantee: inner\n";
    EXPECT_EQ(failure(stages),
              "stage 'spherize.misbehaving', link 'tip', input 'cylinder': no sphere of this link lies inside its "
              "geometry; remedy: more spheres, another spherizer, or guarantee: outer or fitted; a surface without "
              "inside has no room");
    EXPECT_EQ(code, ErrorCode::geometry);
    const RunResult rest = run(recipe(stages + "on_error: skip\n"), registry, options());
    EXPECT_TRUE(rest.links_lost);
    EXPECT_TRUE(rest.certified);
}

TEST_F(Run, NamesStageLinkAndInputOfAFailure) {
    EXPECT_EQ(failure("stages: [spherize.misbehaving: {how: error, link: tip}]\n"),
              "stage 'spherize.misbehaving', link 'tip', input 'cylinder': this shape is not to my taste");
    EXPECT_EQ(code, ErrorCode::geometry);
    EXPECT_EQ(
        failure("stages: [spherize.misbehaving: {how: exception, link: tip}]\n"),
        "stage 'spherize.misbehaving', link 'tip', input 'cylinder': the stage failed with an exception of its own: "
        "index out of range");
    EXPECT_EQ(code, ErrorCode::plugin);
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: integer, link: tip}]\n"),
                HasSubstr("threw something that is no"));
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST_F(Run, ABrokenContractIsFound) {
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: nothing, link: base}]\n"),
                HasSubstr("it returned no spheres"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: nan, link: base}]\n"), HasSubstr("not finite"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: parents, link: base}]\n"),
                HasSubstr("parent index of level 1"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: many, link: base}]\nbudget: {spheres: 4}\n"),
                HasSubstr("returned 1000 spheres where at most 1 were asked for"));
}

TEST_F(Run, ALostLinkIsOnlyLostOnRequest) {
    const std::string chain = "stages: [spherize.misbehaving: {how: error, link: tip}]\n";
    const RunResult skipped = run(recipe(chain + "on_error: skip\n"), registry, options());
    EXPECT_TRUE(skipped.links_lost);
    EXPECT_THAT(skipped.links[1].error, HasSubstr("not to my taste"));
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<cylinder"));

    const RunResult fallback = run(recipe(chain + "on_error: fallback\n"), registry, options());
    EXPECT_FALSE(fallback.links_lost);
    EXPECT_TRUE(fallback.certified);
    EXPECT_EQ(fallback.links[1].measures.spheres, 1u);
    EXPECT_THAT(fallback.findings, ::testing::Contains(::testing::Field(
                                       &Finding::message, HasSubstr("one enclosing sphere stands in for the link"))));
}

TEST_F(Run, ABudgetBelowOneSphereALinkIsRefused) {
    EXPECT_THAT(failure("stages: [spherize.grid]\nbudget: {spheres: 1}\n"),
                HasSubstr("budget.spheres: 1 is not enough"));
    EXPECT_EQ(code, ErrorCode::recipe);
}

TEST_F(Run, SkippedLinksKeepTheirGeometry) {
    const RunResult result = run(recipe("stages: [spherize.grid]\nlinks: {tip: {skip: true}}\n"), registry, options());
    EXPECT_TRUE(result.links[1].skipped);
    EXPECT_FALSE(result.links_lost);
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<cylinder"));
}

TEST_F(Run, SameBytesOnOneAndFourThreads) {
    for (const std::string budget :
         {"{spheres: 20}", "{excess: 0.9}", "{spheres: 30, excess: 0.9, max_protrusion: 0.05}"}) {
        const Recipe r = recipe("stages: [spherize.octree]\nself_collision: true\nbudget: " + budget + "\n");
        RunOptions one = options("one"), four = options("four");
        one.threads = 1;
        four.threads = 4;
        run(r, registry, one);
        run(r, registry, four);
        for (const char* file : {"two.urdf", "two.json"}) {
            EXPECT_EQ(read_file(folder.path() / "one" / file), read_file(folder.path() / "four" / file))
                << file << budget;
        }
    }
}

TEST_F(Run, TheResolvedRecipeGivesTheSameBytes) {
    run(recipe("stages: [spherize.grid]\nbudget: {spheres: 9}\n"), registry, options("first"));
    const auto resolved = read_recipe(folder.path() / "first/recipe.resolved.yaml", registry);
    ASSERT_TRUE(resolved.ok()) << (resolved.diagnostics.empty() ? "" : resolved.diagnostics[0].text());
    run(resolved.recipes.at(0), registry, options("second"));
    EXPECT_EQ(read_file(folder.path() / "first/two.urdf"), read_file(folder.path() / "second/two.urdf"));
}

TEST_F(Run, TheCacheGivesTheSameBytesAndSaysSo) {
    const Recipe r = recipe("stages: [spherize.grid]\nbudget: {spheres: 9}\n");
    RunOptions o = options("first");
    o.fresh = false;
    o.cache = folder.path() / "cache";
    const RunResult first = run(r, registry, o);
    o.out = folder.path() / "second";
    const RunResult second = run(r, registry, o);
    EXPECT_EQ(read_file(folder.path() / "first/two.urdf"), read_file(folder.path() / "second/two.urdf"));
    EXPECT_EQ(first.links[0].stages[0].stage, "spherize.grid");
    EXPECT_FALSE(first.links[0].stages[0].cached);
    EXPECT_TRUE(second.links[0].stages[0].cached);
    EXPECT_EQ(first.links[0].stages[0].output, second.links[0].stages[0].output);
}

TEST_F(Run, FiltersSayWhatTheyDidFreshAndCached) {
    // A cube without its lid.
    write_file(folder.path() / "open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                           "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    const auto result = parse_recipe("foam: 1\nname: open\nmesh: open.obj\nstages: [repair.auto, spherize.octree]\n"
                                     "budget: {spheres: 4}\n",
                                     folder.path() / "open.yaml", registry);
    RunOptions o = options();
    o.fresh = false;
    o.cache = folder.path() / "cache";
    for (const bool cached : {false, true}) {
        const RunResult made = run(result.recipes.at(0), registry, o);
        const StageReport& repair = made.links.at(0).stages.at(1);
        EXPECT_EQ(repair.stage, "repair.auto");
        EXPECT_EQ(repair.cached, cached);
        ASSERT_TRUE(repair.change);
        EXPECT_EQ(repair.change->triangles_before, 10u);
        EXPECT_EQ(repair.change->triangles_after, 12u);
        EXPECT_EQ(repair.change->before.boundary_edges, 4u);
        EXPECT_FALSE(repair.change->volume_before);
        EXPECT_NEAR(repair.change->volume_after.value(), 1, 1e-12);
        EXPECT_NEAR(repair.change->output_to_input.max, 0.5, 0.05); // the middle of the lid
        EXPECT_LT(repair.change->input_to_output.max, 1e-12);
        EXPECT_THAT(read_file(folder.path() / "out/manifest.json"),
                    HasSubstr("\"defects_before\": \"4 boundary edges\""));
    }
}

/// Findings and metrics of a stage, whether it ran or its result came from the cache.
std::vector<std::string> words_of(const RunResult& result) {
    std::vector<std::string> words;
    for (const Finding& finding : result.findings) {
        words.push_back(finding.link + " " + finding.stage + ": " + finding.message);
    }
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            for (const StageReport::Metric& metric : stage.metrics) {
                words.push_back(link.link + " " + stage.stage + ": " + metric.name + " " +
                                std::to_string(metric.value) + " " + metric.unit);
            }
        }
    }
    return words;
}

TEST_F(Run, CachedStagesSayWhatTheySaid) {
    write_file(folder.path() / "open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                           "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    write_file(folder.path() / "two.urdf",
               "<robot name=\"two\"><link name=\"base\"><collision><geometry><mesh filename=\"open.obj\"/></geometry>"
               "</collision></link><link name=\"tip\"><collision><geometry><cylinder radius=\"0.05\" length=\"0.3\"/>"
               "</geometry></collision></link><joint name=\"j\" type=\"fixed\"><parent link=\"base\"/>"
               "<child link=\"tip\"/></joint></robot>");
    const std::string chain = "stages: [repair.watertight: {leaves: 200}, smooth.humphrey, spherize.misbehaving]\n";
    RunOptions o = options();
    o.fresh = false;
    o.cache = folder.path() / "cache";
    const auto words = [&](const char* budget) { return words_of(run(recipe(chain + budget), registry, o)); };
    const std::vector<std::string> first = words("budget: {spheres: 6}\n");
    EXPECT_THAT(first, ::testing::IsSupersetOf({"tip spherize.misbehaving: asked for a sphere",
                                                "tip spherize.misbehaving: budgets 1.000000 1"}));
    EXPECT_EQ(words("budget: {spheres: 6}\n"), first);
    const std::vector<std::string> partly = words("budget: {spheres: 9}\n");
    EXPECT_EQ(words("budget: {spheres: 9}\n"), partly);
}

TEST_F(Run, CancellationLeavesTheFormerRunAsItWas) {
    run(recipe("stages: [spherize.grid]\n"), registry, options());
    const std::string before = read_file(folder.path() / "out/manifest.json");
    std::atomic<bool> cancel = false;
    RunOptions o = options();
    o.cancel = &cancel;
    const Recipe endless = recipe("stages: [spherize.misbehaving: {how: waits, link: tip}]\n");
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        cancel = true;
    });
    try {
        run(endless, registry, o);
        ADD_FAILURE() << "the run ended by itself";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    stopper.join();
    EXPECT_EQ(read_file(folder.path() / "out/manifest.json"), before);
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_THAT(entry.path().filename().string(), ::testing::Not(HasSubstr("partial")));
    }
}

/// Asks the run to stop once a stage has finished so many tasks.
class StopAfter final : public Observer {
public:
    StopAfter(std::string stage, std::size_t tasks) : stage_(std::move(stage)), tasks_(tasks) {}
    void on(const Event& event) override {
        if (event.kind == Event::Kind::task_finished && event.stage == stage_ && --tasks_ == 0) {
            stop = true;
        }
    }
    std::atomic<bool> stop = false;

private:
    std::string stage_;
    std::size_t tasks_;
};

TEST_F(Run, AStopGivesTheBestSoFar) {
    const Recipe r = recipe("stages: [spherize.grid]\nbudget: {spheres: 60}\n");
    const RunResult whole = run(r, registry, options("whole"));
    EXPECT_EQ(whole.cut, Cut::none);
    StopAfter observer("spherize.grid", 4); // the first two rounds of both links
    RunOptions o = options();
    o.observer = &observer;
    o.stop = &observer.stop;
    const RunResult result = run(r, registry, o);
    EXPECT_EQ(result.cut, Cut::stop);
    EXPECT_TRUE(result.certified);
    EXPECT_GE(result.total.spheres, 8u) << "counts to four are known of each after the first round";
    EXPECT_LT(result.total.spheres, whole.total.spheres);
    EXPECT_EQ(warnings_of(result),
              std::vector<std::string>{": the search was stopped: these are the best spheres until "
                                       "then, and another run may give others"});
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"cut\": \"stop\""));
    EXPECT_THAT(read_file(folder.path() / "whole/manifest.json"), ::testing::Not(HasSubstr("\"cut\"")));
    try {
        verify(folder.path() / "out", registry, {});
        ADD_FAILURE() << "verified";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), (folder.path() / "out/manifest.json").string() +
                                    ": the search of this run was cut short (stop), so it cannot be expected to come "
                                    "out the same again; remedy: run its recipe without a limit");
    }
}

TEST_F(Run, AStopBeforeThereIsAModelCancels) {
    run(recipe("stages: [spherize.grid]\n"), registry, options());
    const std::string before = read_file(folder.path() / "out/manifest.json");
    for (const std::string budget : {"{spheres: 60}", "{excess: 0.2}", "{max_protrusion: 0.06}", "{}"}) {
        StopAfter observer("load.urdf", 1);
        RunOptions o = options();
        o.observer = &observer;
        o.stop = &observer.stop;
        try {
            run(recipe("stages: [spherize.grid]\nbudget: " + budget + "\n"), registry, o);
            ADD_FAILURE() << "the run ended by itself";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
        EXPECT_EQ(read_file(folder.path() / "out/manifest.json"), before);
    }
}

TEST_F(Run, AStopAtTheEndChangesNothing) {
    const Recipe r = recipe("stages: [spherize.grid]\nbudget: {spheres: 9}\n");
    run(r, registry, options("whole"));
    StopAfter observer("cover", 1);
    RunOptions o = options();
    o.observer = &observer;
    o.stop = &observer.stop;
    EXPECT_EQ(run(r, registry, o).cut, Cut::none);
    EXPECT_EQ(read_file(folder.path() / "out/two.urdf"), read_file(folder.path() / "whole/two.urdf"));
}

TEST_F(Run, ATimeLimitThatIsOverLeavesTheFewestSpheres) {
    RunOptions o = options();
    o.time_limit = 1e-9;
    for (const std::string budget : {"{spheres: 60}", "{excess: 0.2}", "{max_protrusion: 0.06}", "{}"}) {
        for (const std::string links : {"", "links: {tip: {skip: true}}\n"}) {
            const RunResult result =
                run(recipe("stages: [spherize.grid]\n" + links + "budget: " + budget + "\n"), registry, o);
            EXPECT_EQ(result.cut, Cut::time_limit) << budget;
            EXPECT_TRUE(result.certified);
            EXPECT_EQ(result.total.spheres, links.empty() ? 2u : 1u) << budget;
            EXPECT_THAT(warnings_of(result),
                        ::testing::Contains(": the search ended at its time limit of 1e-09 s: these are the best "
                                            "spheres until then, and another run may give others"));
        }
    }
    const RunResult result =
        run(recipe("stages: [spherize.grid]\nbudget: {spheres: 60, time_limit: 0.001}\n"), registry, options());
    EXPECT_EQ(result.cut, Cut::time_limit);
    EXPECT_TRUE(result.certified);
}

TEST_F(Run, ATimeLimitThatDoesNotComeChangesNothing) {
    for (const std::string links : {"", "links: {tip: {skip: true}}\n"}) {
        const Recipe r = recipe("stages: [spherize.grid]\n" + links + "budget: {spheres: 30}\n");
        run(r, registry, options("without"));
        RunOptions o = options();
        o.time_limit = 1e9;
        EXPECT_EQ(run(r, registry, o).cut, Cut::none);
        EXPECT_EQ(read_file(folder.path() / "out/two.json"), read_file(folder.path() / "without/two.json"));
    }
}

TEST_F(Run, ATimeLimitInBetweenKeepsTheStepsOfOneLink) {
    const Recipe r = recipe("stages: [spherize.grid]\nlinks: {tip: {skip: true}}\nbudget: {spheres: 100}\n");
    StopAfter observer("spherize.grid", 6); // of 1, 2 and so on
    RunOptions o = options();
    o.observer = &observer;
    o.stop = &observer.stop;
    o.time_limit = 1e9;
    const RunResult result = run(r, registry, o);
    EXPECT_EQ(result.cut, Cut::stop);
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.total.spheres, 4u);
    EXPECT_LE(result.total.spheres, 8u);
}

TEST_F(Run, WhatWasCutIsNotKeptInTheCache) {
    const Recipe r = recipe("stages: [spherize.cover]\nbudget: {spheres: 12}\n");
    run(r, registry, options("whole"));
    StopAfter observer("spherize.cover", 2);
    RunOptions o = options();
    o.fresh = false;
    o.cache = folder.path() / "cache";
    o.observer = &observer;
    o.stop = &observer.stop;
    EXPECT_EQ(run(r, registry, o).cut, Cut::stop);
    o.stop = nullptr;
    EXPECT_EQ(run(r, registry, o).cut, Cut::none);
    EXPECT_EQ(read_file(folder.path() / "out/two.urdf"), read_file(folder.path() / "whole/two.urdf"));
}

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
        const auto spheres = registry.make<Writer>("write.urdf")->read(read_file(folder.path() / "out/two.urdf"));
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
                    "table: its spheres overlap those of tool by 0\\.[0-9]+ m in the pose of self_collision, where the "
                    "geometry of the two is apart; remedy: more spheres for both, or max_protrusion")));
    // Where the geometry touches, spheres that cover it must.
    const RunResult touching = made("budget: {spheres: 4}\nself_collision: {pose: {slide: -0.04}}\n");
    EXPECT_THAT(warnings_of(touching), ::testing::Not(::testing::Contains(HasSubstr("overlap"))));
    EXPECT_EQ(failure("stages: [spherize.grid]\nself_collision: {pose: {knee: 1}}\n").substr(0, 21),
              "self_collision.pose: ");
    EXPECT_EQ(code, ErrorCode::recipe);
}

TEST_F(Run, NoInputThatExists) {
    const auto result =
        parse_recipe("foam: 1\nname: x\nrobot: {urdf: [package://no_such/a.urdf, b.urdf]}\nstages: [spherize.grid]\n",
                     folder.path() / "x.yaml", registry);
    ASSERT_TRUE(result.ok());
    try {
        run(result.recipes.at(0), registry, options());
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_THAT(error.what(), HasSubstr("none of the inputs [package://no_such/a.urdf, b.urdf] exists"));
        EXPECT_THAT(error.what(), HasSubstr((folder.path() / "b.urdf").string()));
        EXPECT_THAT(error.what(), HasSubstr("remedy"));
    }
}

} // namespace
} // namespace foam
