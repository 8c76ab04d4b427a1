// Runs that are cancelled, stopped, or at the end of their time.
#include "small_robot.hpp"

#include <foam/runtime/verify.hpp>

#include <thread>

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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

TEST_F(Run, AStopGivesTheBestSoFar) {
    const Recipe r = recipe("stages: [spherize.grid]\nbudget: {spheres: 60}\n");
    const RunResult whole = run(r, registry, options("whole"));
    EXPECT_EQ(whole.cut, Cut::none);
    StopAfter observer("spherize.grid", 5); // until both links have had two rounds
    RunOptions o = options();
    o.observer = &observer;
    o.stop = &observer.stop;
    const RunResult result = run(r, registry, o);
    EXPECT_EQ(result.cut, Cut::stop);
    EXPECT_TRUE(result.certified);
    EXPECT_GE(result.total.spheres, 8u) << "counts to four are known of each after two rounds";
    EXPECT_LT(result.total.spheres, whole.total.spheres);
    EXPECT_EQ(warnings_of(result),
              std::vector<std::string>{
                  ": the search was stopped: these are the best elements so far; another run may give others"});
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"cut\": \"stop\""));
    EXPECT_THAT(read_file(folder.path() / "whole/manifest.json"), ::testing::Not(HasSubstr("\"cut\"")));
    try {
        verify(folder.path() / "out", registry, {});
        ADD_FAILURE() << "verified";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(), (folder.path() / "out/manifest.json").string() +
                                    ": the search of this run ended early (stop), so another run may give other "
                                    "spheres; remedy: run its recipe without a limit");
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

/// Runs the recipe. Returns nothing where a slow or busy machine has no time left to prove even one sphere a link.
std::optional<RunResult> run_in_time(const Recipe& recipe, Registry& registry, const RunOptions& options) {
    try {
        return run(recipe, registry, options);
    } catch (const Error& error) {
        if (std::string_view(error.what()).starts_with("the time limit of")) {
            return std::nullopt;
        }
        throw;
    }
}

TEST_F(Run, ATimeLimitThatIsOverLeavesTheFewestSpheres) {
    RunOptions o = options();
    o.time_limit = 1e-9;
    for (const std::string budget : {"{spheres: 60}", "{excess: 0.2}", "{max_protrusion: 0.06}", "{}"}) {
        for (const std::string links : {"", "links: {tip: {skip: true}}\n"}) {
            const auto in_time =
                run_in_time(recipe("stages: [spherize.grid]\n" + links + "budget: " + budget + "\n"), registry, o);
            if (!in_time) {
                GTEST_SKIP() << "this machine is too slow";
            }
            const RunResult& result = *in_time;
            EXPECT_EQ(result.cut, Cut::time_limit) << budget;
            EXPECT_EQ(result.certified, links.empty()) << "a link that is skipped is not proved";
            EXPECT_EQ(result.proved.proved, links.empty() ? 2u : 1u);
            EXPECT_EQ(result.total.spheres, links.empty() ? 2u : 1u) << budget;
            EXPECT_THAT(warnings_of(result),
                        ::testing::Contains(": the search ended at its time limit of 1e-09 s: these are the best "
                                            "elements so far; another run may give others"));
        }
    }
    const auto result = run_in_time(recipe("stages: [spherize.grid]\nbudget: {spheres: 60, time_limit: 0.001}\n"),
                                    registry, options());
    if (!result) {
        GTEST_SKIP() << "this machine is too slow";
    }
    EXPECT_EQ(result->cut, Cut::time_limit);
    EXPECT_TRUE(result->certified);
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
    const Recipe r =
        recipe("stages: [spherize.grid, refine.split]\nlinks: {tip: {skip: true}}\nbudget: {spheres: 100}\n");
    StopAfter observer("spherize.grid", 6); // of 1, 2 and so on
    RunOptions o = options();
    o.observer = &observer;
    o.stop = &observer.stop;
    o.time_limit = 1e9;
    const RunResult result = run(r, registry, o);
    EXPECT_EQ(result.cut, Cut::stop);
    EXPECT_EQ(result.proved.proved, 1u);
    EXPECT_GT(result.total.spheres, 4u);
    EXPECT_LE(result.total.spheres, 8u);
}

TEST_F(Run, ATimeLimitBeforeThereIsAModelSaysWhereTheTimeWent) {
    run(recipe("stages: [spherize.grid]\n"), registry, options());
    const std::string before = read_file(folder.path() / "out/manifest.json");
    RunOptions o = options();
    o.time_limit = 0.2;
    try {
        run(recipe("stages: [spherize.misbehaving: {how: waits, link: tip}]\nguarantee: inner\n"), registry, o);
        ADD_FAILURE() << "the run ended by itself";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        EXPECT_STREQ(error.what(), "stage 'spherize.misbehaving', link 'tip': no sphere was found within the time limit "
                                   "of 0.2 s; remedy: more time");
    }
    EXPECT_EQ(read_file(folder.path() / "out/manifest.json"), before);
}

TEST_F(Run, ABallStandsInForWhatIsNotFoundInTime) {
    RunOptions o = options();
    o.time_limit = 2;
    const auto result = run_in_time(
        recipe("stages: [spherize.misbehaving: {how: waits, link: tip}]\nbudget: {spheres: 20}\n"), registry, o);
    if (!result) {
        GTEST_SKIP() << "this machine is too slow";
    }
    EXPECT_EQ(result->cut, Cut::time_limit);
    EXPECT_TRUE(result->certified);
    EXPECT_EQ(result->links.at(1).measures.spheres, 1u);
    EXPECT_THAT(warnings_of(*result),
                ::testing::Contains(
                    "tip: it found no spheres within the time limit of 2 s; one enclosing sphere replaces them"));
}

constexpr const char* of_a_mesh = R"(<robot name="two">
<link name="base"><collision><origin xyz="0 0 1"/><geometry><mesh filename="wedge.obj"/></geometry></collision></link>
<link name="tip"><collision><geometry><box size="1 1 1"/></geometry></collision>
<collision><origin xyz="1 0 0"/><geometry><mesh filename="wedge.obj"/></geometry></collision></link>
<joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint></robot>)";
constexpr const char* wedge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* waiting_filter = "stages: [smooth.waiting, spherize.grid]\n";

TEST_F(Run, ATimeLimitInThePreparationLeavesOneProvedSphereALink) {
    write("two.urdf", of_a_mesh);
    write("wedge.obj", wedge);
    RunOptions o = options();
    o.time_limit = 0.5;
    for (const std::string rest : {"budget: {spheres: 20}\n", "per: collision\nhollow: fill\nguarantee: fitted\n",
                                   "links: {tip: {keep: [[5, 5, 5, 0.1]]}}\n"}) {
        const auto result = run_in_time(recipe(waiting_filter + rest), registry, o);
        if (!result) {
            GTEST_SKIP() << "this machine is too slow";
        }
        EXPECT_EQ(result->cut, Cut::time_limit);
        const bool outer = rest.find("fitted") == std::string::npos;
        EXPECT_EQ(result->certified, outer) << rest;
        EXPECT_EQ(result->proved.proved, outer ? 2u : 0u);
        EXPECT_EQ(result->links.at(0).measures.spheres, 1u);
        EXPECT_EQ(result->links.at(1).measures.spheres, rest.starts_with("links") ? 2u : 1u);
        EXPECT_GT(result->links.at(1).measures.excess_volume, 0);
        EXPECT_THAT(warnings_of(*result),
                    ::testing::Contains("base: the time limit of 0.5 s is too short to prepare its geometry, and to "
                                        "search and measure: one enclosing sphere covers it"));
        EXPECT_EQ(spheres_in("out/two.urdf").size(), 2u) << "the file is there, and was proved as it was read back";
    }
}

TEST_F(Run, ATimeLimitInThePreparationIsAnErrorWhereOneSphereIsNoResult) {
    write("two.urdf", of_a_mesh);
    write("wedge.obj", wedge);
    for (const std::string rest : {"guarantee: inner\n", "budget: {spheres: 1}\n"}) {
        RunOptions o = options();
        o.time_limit = 0.2;
        try {
            run(recipe(waiting_filter + rest), registry, o);
            ADD_FAILURE() << rest;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("the time limit of 0.2 s ended")) << rest;
        }
    }
}

TEST_F(Run, WhatGoesOnAfterAStopIsNamed) {
    const std::filesystem::path release = folder.path() / "release";
    std::atomic<bool> stop = false;
    std::vector<Unresponsive> told;
    RunOptions o = options();
    o.stop = &stop;
    o.on_unresponsive = [&](const Unresponsive& what) {
        told.push_back(what);
        std::ofstream{release} << "\n";
    };
    const Recipe deaf =
        recipe("stages: [spherize.misbehaving: {how: 'deaf until " + release.string() + "', link: tip}]\n");
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop = true;
    });
    try {
        run(deaf, registry, o);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    stopper.join();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].asked, Cut::stop);
    EXPECT_GE(told[0].seconds, 1.9);
    EXPECT_THAT(told[0].at, ::testing::Contains(HasSubstr("stage 'spherize.misbehaving', link 'tip'")));
}

} // namespace
} // namespace foam
