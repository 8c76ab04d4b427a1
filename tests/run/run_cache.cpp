// What runs take from the cache, and that they say the same then.
#include "small_robot.hpp"

namespace foam {
namespace {

using ::testing::HasSubstr;

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

} // namespace
} // namespace foam
