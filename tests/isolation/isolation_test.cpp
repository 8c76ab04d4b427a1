// isolate: process: what comes out is what comes out without; whatever a stage does, the run goes on and names stage,
// link and input.
#include "cli/program.hpp"
#include "ill.hpp"
#include "support/runs.hpp"

#include <foam/base/error.hpp>

#include <atomic>
#include <cctype>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class Isolation : public RunTest {
protected:
    Isolation() {
        const PluginRecord& plugin = registry.load(FOAM_TEST_ILL_BEHAVED);
        EXPECT_TRUE(plugin.loaded()) << plugin.rejection;
        write("two.urdf", two_links_urdf);
        write("box.obj", box_obj);
    }

    Recipe recipe(const std::string& rest) { return recipe_of("name: two\nrobot: {urdf: two.urdf}\n" + rest); }
    RunOptions options(const std::string& out = "out") const {
        RunOptions result = RunTest::options(out);
        result.program = FOAM_TEST_BINARY;
        return result;
    }
    RunResult run_of(const std::string& rest, const std::string& out = "out") {
        return run(recipe(rest), registry, options(out));
    }
    std::string failure(const std::string& rest) {
        try {
            run_of(rest);
        } catch (const Error& error) {
            code = error.code();
            EXPECT_FALSE(fs::exists(folder.path() / "out"));
            return error.what();
        }
        return "no error";
    }
    /// The filter misbehaves on the link `tip`.
    std::string filter_failure(const std::string& how, const std::string& limits = "") {
        return failure("stages: [repair.ill: {isolate: process" + limits + "}, spherize.ill]\n" +
                       "links: {tip: {repair.ill: {how: " + how + "}}}\n");
    }

    ErrorCode code = ErrorCode::internal;
};

constexpr const char* in_filter = "stage 'repair.ill', link 'tip', input 'box.obj': ";

std::vector<std::string> metrics_of(const RunResult& result) {
    std::vector<std::string> lines;
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            for (const StageReport::Metric& metric : stage.metrics) {
                lines.push_back(link.link + " " + stage.stage + " " + metric.name + " " + to_text(metric.value) + " " +
                                metric.unit);
            }
        }
    }
    return lines;
}

std::vector<std::string> messages_of(const RunResult& result) {
    std::vector<std::string> lines;
    for (const Finding& finding : result.findings) {
        lines.push_back(finding.link + " " + finding.stage + " " + finding.message);
    }
    return lines;
}

TEST_F(Isolation, GivesTheSameBytesMetricsAndFindings) {
    const std::string chain = "stages: [repair.ill, simplify.quadric: {ratio: 0.9}, spherize.grid]\n"
                              "budget: {spheres: 10}\n";
    const RunResult here = run_of(chain, "here");
    const RunResult there = run_of(chain + "isolate: process\n", "there");
    EXPECT_TRUE(there.certified);
    for (const char* file : {"two.urdf", "two.json"}) {
        EXPECT_EQ(contents(folder.path() / "here" / file), contents(folder.path() / "there" / file)) << file;
        EXPECT_NE(contents(folder.path() / "here" / file), "");
    }
    EXPECT_EQ(messages_of(here), messages_of(there));
    EXPECT_THAT(messages_of(there),
                IsSupersetOf({"base repair.ill working on 12 triangles", "tip repair.ill working on 12 triangles"}));
    EXPECT_EQ(metrics_of(here), metrics_of(there));
    EXPECT_GE(metrics_of(there).size(), 4U);
}

TEST_F(Isolation, SharesItsCacheWithRunsInOneProcess) {
    const std::string chain = "stages: [repair.ill, spherize.ill]\nbudget: {spheres: 2}\n";
    RunOptions cached = options();
    cached.fresh = false;
    cached.cache = folder.path() / "cache";
    const RunResult first = run(recipe(chain + "isolate: process\n"), registry, cached);
    const RunResult again = run(recipe(chain), registry, cached);
    EXPECT_EQ(messages_of(first), messages_of(again));
    EXPECT_EQ(metrics_of(first), metrics_of(again));
    for (const LinkReport& link : again.links) {
        for (const StageReport& stage : link.stages) {
            const bool of_plugin = stage.stage == "repair.ill" || stage.stage == "spherize.ill";
            EXPECT_EQ(stage.cached, of_plugin) << link.link << " " << stage.stage;
        }
    }
}

/// Its child loads the plugins of the others, too.
TEST_F(Isolation, AStageMadeOfOthersHasThem) {
    for (const char* fixture : {"/fixture_composed.so", "/fixture_used.so"}) {
        const PluginRecord& plugin = registry.load(FOAM_TEST_FIXTURES + std::string(fixture));
        ASSERT_TRUE(plugin.loaded()) << plugin.rejection;
    }
    const std::string chain = "stages: [repair.composed, spherize.ill]\nbudget: {spheres: 2}\n";
    const RunResult here = run_of(chain, "here"), there = run_of(chain + "isolate: process\n", "there");
    const auto composed = [](const RunResult& result) { return result.links.at(0).stages.at(1); };
    EXPECT_EQ(composed(here).stage, "repair.composed");
    EXPECT_EQ(composed(there).output, composed(here).output);
    EXPECT_GT(composed(there).change.value().input_to_output.max, 0.5)
        << "repair.shift, of the other plugin, is missing";
}

TEST_F(Isolation, HandsOnWhatAStageThrows) {
    EXPECT_EQ(filter_failure("error"), std::string(in_filter) + "this is not to my taste");
    EXPECT_EQ(code, ErrorCode::geometry);
    EXPECT_EQ(filter_failure("exception"), std::string(in_filter) + "the stage threw an exception: index out of range");
    EXPECT_EQ(code, ErrorCode::plugin);
    EXPECT_EQ(filter_failure("integer"),
              std::string(in_filter) + "the stage threw an object that is not a std::exception");
}

TEST_F(Isolation, NamesACrashOfAFilter) {
    if (sanitized) {
        EXPECT_THAT(filter_failure("segv"), HasSubstr("its own process ("));
        return;
    }
    EXPECT_EQ(filter_failure("segv"),
              std::string(in_filter) +
                  "the stage crashed in its own process (SIGSEGV, invalid memory access or stack overflow)");
    EXPECT_EQ(code, ErrorCode::plugin);
    EXPECT_EQ(filter_failure("overflow"),
              std::string(in_filter) +
                  "the stage crashed in its own process (SIGSEGV, invalid memory access or stack overflow)");
    EXPECT_EQ(filter_failure("abort"),
              std::string(in_filter) + "the stage crashed in its own process (SIGABRT, the program aborted)");
    EXPECT_EQ(filter_failure("segv_in_thread", ", memory_limit: 4096"),
              std::string(in_filter) +
                  "the stage crashed in its own process (SIGSEGV, invalid memory access or stack overflow); its "
                  "memory_limit of 4096 MiB may be too little for it");
}

TEST_F(Isolation, NamesAnEarlyEnd) {
    EXPECT_EQ(filter_failure("exit"),
              std::string(in_filter) + "the stage ended its own process (exit code 3) without a result");
    EXPECT_EQ(code, ErrorCode::plugin);
}

TEST_F(Isolation, NamesACrashOfASpherizer) {
    const std::string message = failure("stages: [spherize.ill: {isolate: process}]\n"
                                        "links: {tip: {spherize.ill: {how: abort}}}\n");
    EXPECT_THAT(message, HasSubstr("stage 'spherize.ill', link 'tip', input 'box.obj': the stage "));
    EXPECT_THAT(message, HasSubstr(" its own process ("));
}

TEST_F(Isolation, NamesACrashOfALoader) {
    write("bad.ill", "abort\n");
    write("two.urdf", "<robot name=\"one\"><link name=\"base\"><collision><geometry><mesh filename=\"bad.ill\"/>"
                      "</geometry></collision></link></robot>\n");
    const std::string message = failure("stages: [spherize.ill]\nisolate: process\n");
    EXPECT_THAT(message, HasSubstr("stage 'load.ill', link 'base', input '" + (folder.path() / "bad.ill").string() +
                                   "': the stage "));
    EXPECT_THAT(message, HasSubstr(" its own process ("));
}

/// A mesh of a loader that wishes for a process of its own.
class WishedIsolation : public Isolation {
protected:
    std::string failure_of(const std::string& how, const std::string& rest = "") {
        write("mesh.wishing", how + "\n");
        const Recipe mesh = recipe_of("mesh: mesh.wishing\nstages: [spherize.ill]\n" + rest);
        try {
            run(mesh, registry, options());
        } catch (const Error& error) {
            code = error.code();
            return error.what();
        }
        return "";
    }
    std::string place() const {
        return "stage 'load.wishing', link 'mesh', input '" + (folder.path() / "mesh.wishing").string() + "': ";
    }
};

TEST_F(WishedIsolation, ACrashIsReportedWithFileAndRemedy) {
    EXPECT_EQ(failure_of("well"), "");
    EXPECT_EQ(failure_of("exit"),
              place() + "the stage ended its own process (exit code 3) without a result; remedy: the file may be "
                        "damaged: export it again, or as STL, OBJ, PLY, DAE, OFF or GLB");
    EXPECT_EQ(code, ErrorCode::plugin);
    if (!sanitized) {
        EXPECT_EQ(failure_of("abort"),
                  place() + "the stage crashed in its own process (SIGABRT, the program aborted); remedy: the file may "
                            "be damaged: export it again, or as STL, OBJ, PLY, DAE, OFF or GLB");
    }
}

TEST_F(WishedIsolation, TheRecipeOverrulesIt) {
    EXPECT_EQ(failure_of("loop", "loaders: {load.wishing: {time_limit: 1}}\n"),
              place() + "the stage took longer than its time_limit of 1 s and was stopped; remedy: raise the limit, or "
                        "simplify the input");
    const std::string own = "the stage threw an exception: index out of range";
    RunOptions none = options();
    none.program.clear(); // no child can be started
    write("mesh.wishing", "exception\n");
    for (const char* rest : {"isolate: none\n", "loaders: {load.wishing: {isolate: none}}\n",
                             "isolate: process\nloaders: {load.wishing: {isolate: none}}\n"}) {
        try {
            run(recipe_of(std::string("mesh: mesh.wishing\nstages: [spherize.ill]\n") + rest), registry, none);
            ADD_FAILURE() << rest;
        } catch (const Error& error) {
            EXPECT_EQ(error.what(), place() + own) << rest;
        }
    }
}

TEST_F(Isolation, EndsAnEndlessLoopAtItsTimeLimit) {
    EXPECT_EQ(filter_failure("loop", ", time_limit: 1"),
              std::string(in_filter) +
                  "the stage took longer than its time_limit of 1 s and was stopped; remedy: raise "
                  "the limit, or simplify the input");
    EXPECT_EQ(code, ErrorCode::geometry);
}

TEST_F(Isolation, EndsAHungryStageAtItsMemoryLimit) {
    if (sanitized) {
        EXPECT_THAT(filter_failure("well", ", memory_limit: 512"), HasSubstr("cannot enforce a memory_limit"));
        return;
    }
    EXPECT_EQ(filter_failure("eat", ", memory_limit: 512"),
              std::string(in_filter) +
                  "the stage needs more memory than its memory_limit of 512 MiB; remedy: raise the "
                  "limit, or simplify the input");
    EXPECT_EQ(code, ErrorCode::geometry);
}

TEST_F(Isolation, ObeysThePolicyForLostLinks) {
    const std::string chain = "stages: [repair.ill: {isolate: process}, spherize.ill]\n"
                              "links: {tip: {repair.ill: {how: abort}}}\n";
    const RunResult skipped = run_of(chain + "on_error: skip\n");
    EXPECT_TRUE(skipped.links_lost);
    EXPECT_EQ(skipped.links.at(0).error, "");
    EXPECT_THAT(skipped.links.at(1).error, HasSubstr(in_filter));
    EXPECT_THAT(contents(folder.path() / "out/two.urdf"), HasSubstr("scale=\"1 2 1\""));

    const RunResult fallback = run_of(chain + "on_error: fallback\n");
    EXPECT_FALSE(fallback.links_lost);
    EXPECT_TRUE(fallback.certified);
    EXPECT_EQ(fallback.links.at(1).measures.spheres, 1u);
    EXPECT_THAT(messages_of(fallback), ::testing::Contains(HasSubstr("tip  one enclosing sphere replaces the link: " +
                                                                     std::string(in_filter))));
}

TEST_F(Isolation, ACornerThatTheMeshHasNotIsFound) {
    EXPECT_EQ(failure("stages: [repair.ill, spherize.ill]\nlinks: {tip: {repair.ill: {how: corner}}}\n"),
              std::string(in_filter) + "the filter broke its contract: triangle 11 has corner 1000000 of 8 vertices");
    EXPECT_EQ(code, ErrorCode::plugin);
}

TEST_F(Isolation, NeedsAProgram) {
    RunOptions without = options();
    without.program.clear();
    try {
        run(recipe("stages: [spherize.ill]\nisolate: process\n"), registry, without);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_THAT(error.what(), HasSubstr("this program cannot run stages in child processes; remedy: delete "
                                            "'isolate' from the recipe, or run it with foam"));
    }
}

/// Asks to stop when the stage has said something.
class StopAtTheFirstFinding final : public Observer {
public:
    void on(const Event& event) override {
        if (event.kind == Event::Kind::finding) {
            stop = true;
        }
    }
    std::atomic<bool> stop{false};
};

TEST_F(Isolation, CancellationEndsTheStage) {
    StopAtTheFirstFinding observer;
    RunOptions cancelled = options();
    cancelled.observer = &observer;
    cancelled.cancel = &observer.stop;
    try {
        run(recipe("stages: [spherize.ill: {isolate: process, how: loop}]\n"), registry, cancelled);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

} // namespace
} // namespace foam::test
