// Crashes as a user meets them: without isolation foam names what it was at and leaves nothing behind; with it no
// process stays behind.
#include "cli/program.hpp"
#include "ill.hpp"

#include <cctype>
#include <chrono>
#include <csignal>
#include <thread>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class IsolationCli : public Cli {
protected:
    IsolationCli() {
        write("two.urdf", two_links_urdf);
        write("box.obj", box_obj);
    }
    /// Runs two.yaml of these stages.
    Outcome run(const std::string& stages, const std::string& more = "") const {
        write_recipe(stages);
        return foam("run two.yaml --fresh " + more);
    }
    void write_recipe(const std::string& stages) const {
        write("two.yaml", "foam: 1\nrobot: {urdf: two.urdf}\nplugins: ['" FOAM_TEST_ILL_BEHAVED "']\n" + stages);
    }
    /// A spherizer that never ends, and writes its process to the file "process".
    std::string looping(const std::string& isolation = "") const {
        return "stages: [spherize.ill: {" + isolation + "how: loop, process_file: '" + (path() / "process").string() +
               "'}]\n";
    }
    void expect_nothing_left() const {
        EXPECT_FALSE(fs::exists(path() / "runs/two"));
        for (const auto& entry : fs::directory_iterator(path() / "runs")) {
            ADD_FAILURE() << entry.path() << " was left behind";
        }
    }
    void expect_crash(const std::string& how, const std::string& words, int signal) const {
        const Outcome outcome =
            run("stages: [repair.ill, spherize.ill]\nlinks: {tip: {repair.ill: {how: " + how + "}}}\n");
        EXPECT_EQ(outcome.code, 128 + signal) << outcome.err;
        EXPECT_THAT(outcome.err,
                    HasSubstr("\nfoam: crashed (" + words +
                              "\n"
                              "foam: the run directory is as it was before\n"
                              "foam: remedy: `isolate: process` in the recipe (--set isolate=process) runs stages in "
                              "child processes: a crash then affects one link, not the run\n"));
        expect_nothing_left();
    }
};

/// Waits until `file` is there, then gives the process id in it.
pid_t process_in(const fs::path& file) {
    while (!fs::exists(file)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return std::stoi(contents(file));
}

/// Whether a process still works; one that nobody has reaped does not.
bool is_alive(pid_t process) {
    const std::string status = contents("/proc/" + std::to_string(process) + "/stat");
    const std::size_t bracket = status.rfind(')');
    return bracket != status.npos && status.substr(bracket + 2, 1) != "Z" && status.substr(bracket + 2, 1) != "X";
}

/// The test's own time limit ends the wait.
void wait_for_end(pid_t process) {
    while (is_alive(process)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

constexpr const char* segv = "SIGSEGV, invalid memory access or stack overflow) in ";
constexpr const char* at = "stage 'repair.ill', link 'tip', input 'box.obj'";

TEST_F(IsolationCli, ACrashNamesStageLinkAndInput) {
    if (sanitized) {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    expect_crash("segv", std::string(segv) + at, SIGSEGV);
    expect_crash("abort", std::string("SIGABRT, the program aborted) in ") + at, SIGABRT);
}

TEST_F(IsolationCli, SoDoesAStackOverflow) {
    if (sanitized) {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    expect_crash("overflow", std::string(segv) + at, SIGSEGV);
}

TEST_F(IsolationCli, SoDoesACrashInAParallelLoop) {
    if (sanitized) {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    expect_crash("segv_in_parallel", std::string(segv) + at, SIGSEGV);
}

/// Of a thread that foam knows nothing of, all that is at work is told.
TEST_F(IsolationCli, ACrashInAThreadOfTheStagesOwn) {
    if (sanitized) {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    const Outcome outcome = run("stages: [spherize.ill: {how: segv_in_thread}]\n", "-j 1");
    EXPECT_EQ(outcome.code, 128 + SIGSEGV) << outcome.err;
    EXPECT_THAT(
        outcome.err,
        HasSubstr(
            "\n"
            "foam: crashed (SIGSEGV, invalid memory access or stack overflow) in an unknown thread; active stages:\n"
            "  stage 'spherize.ill', link '"));
    expect_nothing_left();
}

TEST_F(IsolationCli, ACrashOfAWriterLeavesNothing) {
    if (sanitized) {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    const Outcome outcome = run("stages: [spherize.ill]\noutputs: [write.json, write.ill: {how: abort}]\n", "-j 1");
    EXPECT_EQ(outcome.code, 128 + SIGABRT) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("crashed (SIGABRT, the program aborted) in stage 'write.ill', input 'two.txt'\n"));
    expect_nothing_left();
}

TEST_F(IsolationCli, ASettingIsolatesAllStages) {
    const Outcome outcome = run("stages: [repair.ill, spherize.ill]\non_error: skip\n"
                                "links: {tip: {spherize.ill: {how: exit}}}\n",
                                "--set isolate=process");
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("stage 'spherize.ill', link 'tip', input 'box.obj': the stage ended its own "
                                       "process (exit code 3) without a result"));
    EXPECT_THAT(contents(path() / "runs/two/recipe.resolved.yaml"), HasSubstr("\nisolate: process\n"));
}

TEST_F(IsolationCli, WhatAnIsolatedStagePrintsIsNoDataOfFoam) {
    const Outcome outcome = run("stages: [spherize.ill: {how: print}]\n", "--json --set isolate=process");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.substr(0, 1), "{");
    EXPECT_THAT(outcome.err, HasSubstr("this is no place to print\n"));
}

TEST_F(IsolationCli, AProgramThatAStageHasStartedEndsWithIt) {
    const Outcome outcome = run("stages: [spherize.ill: {isolate: process, time_limit: 2, how: fork, process_file: '" +
                                (path() / "process").string() + "'}]\n");
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the stage took longer than its time_limit of 2 s and was stopped"));
    if (fs::exists(path() / "process")) { // a slow machine may not have come that far
        wait_for_end(process_in(path() / "process"));
    }
}

/// Killed without a chance to clean up, foam takes its children with it.
TEST_F(IsolationCli, NoOrphanStaysBehind) {
    write_recipe(looping("isolate: process, "));
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' run two.yaml --fresh -j 1 & pid=$!; while [ ! -e process ]; "
                                  "do sleep 0.02; done; kill -KILL $pid; wait $pid");
    EXPECT_EQ(outcome.code, 128 + SIGKILL);
    wait_for_end(process_in(path() / "process"));
}

/// Ctrl-C in a terminal reaches the children, too: it is for foam alone to end them.
TEST_F(IsolationCli, AnInterruptOfTheWholeGroupIsNoCrash) {
    write_recipe(looping("isolate: process, "));
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' run two.yaml --fresh -j 1 & pid=$!; while [ ! -s process ]; "
                                  "do sleep 0.02; done; kill -INT $(cat process); kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("foam: stopped: cancelled; nothing was written\n"));
    expect_nothing_left();
}

/// A stage that never asks whether to stop is named; once more ends it.
TEST_F(IsolationCli, ASecondInterruptEndsWhatNeverAsks) {
    if (signals_wait) {
        GTEST_SKIP() << "the thread sanitizer runs no handler of a signal while the stage computes";
    }
    write_recipe(looping());
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' run two.yaml --fresh -j 1 & pid=$!; while [ ! -e process ]; "
                                  "do sleep 0.02; done; kill -INT $pid; while ! grep -q 'spherize.ill.*link' .err; do "
                                  "sleep 0.02; done; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.code, 128 + SIGINT) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("foam: stopping; a second signal ends it at once\n  stage 'spherize.ill', link '"));
    expect_nothing_left();
}

/// So does the first after a while.
TEST_F(IsolationCli, OneInterruptEndsWhatNeverAsks) {
    if (signals_wait) {
        GTEST_SKIP() << "the thread sanitizer runs no handler of a signal while the stage computes";
    }
    write_recipe(looping());
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' run two.yaml --fresh & pid=$!; while [ ! -e process ]; "
                                  "do sleep 0.02; done; kill -TERM $pid; wait $pid");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("after the start it still works on stage 'spherize.ill', link '"));
    EXPECT_THAT(outcome.err, HasSubstr("nothing was written; remedy: isolate: process for that stage"));
    expect_nothing_left();
}

/// What never asks is named and ended once a time limit is over, in any phase.
TEST_F(IsolationCli, ATimeLimitEndsWhatNeverAsks) {
    for (const std::string stages :
         {"stages: [spherize.ill: {how: loop}]\n", "stages: [repair.ill: {how: loop}, spherize.grid]\n"}) {
        const Outcome outcome = run(stages, "--time-limit 0.5");
        EXPECT_EQ(outcome.code, 1) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("foam: error: the time limit is over, but 1."));
        EXPECT_THAT(outcome.err, HasSubstr("s after the start it still works on stage '"));
        EXPECT_THAT(outcome.err, HasSubstr(".ill', link '"));
        expect_nothing_left();
    }
}

/// In a process of its own it is ended with that: a ball stands in for what it would have made.
TEST_F(IsolationCli, ATimeLimitEndsAnIsolatedStage) {
    const Outcome outcome = run(looping("isolate: process, "), "--time-limit 1");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("it found no spheres within the time limit of 1 s; one enclosing sphere replaces them"));
    wait_for_end(process_in(path() / "process"));
}

TEST_F(IsolationCli, TheHiddenCommandIsForFoamItself) {
    const Outcome outcome = foam("isolated-call </dev/null");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: this command is for foam itself\n");
}

/// Without a process of its own a stage can end the program; then nobody takes it for success.
TEST_F(IsolationCli, AStageThatEndsTheProgramIsNamed) {
    for (const char* how : {"exit", "exit_well", "quick_exit", "exit_now", "exit_at_once", "made_exit"}) {
        const Outcome outcome =
            run("stages: [spherize.ill]\nlinks: {tip: {spherize.ill: {how: " + std::string(how) + "}}}\n", "-j 1");
        EXPECT_EQ(outcome.code, 3) << how;
        EXPECT_THAT(outcome.err,
                    HasSubstr("foam: error: a stage has ended the program; nothing was written; foam worked "
                              "on:\n  stage 'spherize.ill', link 'tip', input 'box.obj'\n"))
            << how;
        expect_nothing_left();
    }
}

/// What a stage must not do ends in an error of this stage and link, and nothing is written.
TEST_F(IsolationCli, AStageThatBreaksWhatOthersRelyOn) {
    const std::string place = "stage 'spherize.ill', link 'tip', input 'box.obj': ";
    const std::pair<const char*, std::string> cases[] = {
        {"shrink", "the geometry is not what was read any more"},
        {"far",
         "the spherizer broke its contract: a sphere reaches more than a million times as far as the shape, which "},
        {"huge",
         "the spherizer broke its contract: a sphere reaches more than a million times as far as the shape, which "},
        {"folder", "the stage changed the working folder of the program; remedy: absolute paths"}};
    for (const auto& [how, words] : cases) {
        const Outcome outcome =
            run("stages: [spherize.ill]\nlinks: {tip: {spherize.ill: {how: " + std::string(how) + "}}}\n");
        EXPECT_EQ(outcome.code, 3) << how;
        EXPECT_THAT(outcome.err, HasSubstr(place + words)) << how;
        expect_nothing_left();
    }
    const Outcome outcome = run("stages: [spherize.ill]\nlinks: {tip: {spherize.ill: {how: long}}}\n");
    EXPECT_LT(outcome.err.size(), 4000u);
}

} // namespace
} // namespace foam::test
