// What a shell sees of a command that the user has cut.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;

/// Runs a loop of bash in a session of its own, and sends its group a signal, as a terminal does, when a file is there
/// and a time is over.
constexpr const char* interrupt_group = R"(
import glob, os, signal, subprocess, sys, time
file, name, wait = sys.argv[1:4]
shell = subprocess.Popen(['bash', 'loop.sh'], start_new_session=True, stdout=open('rounds', 'w'), stderr=subprocess.STDOUT,
                         preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
end = time.monotonic() + 60
while time.monotonic() < end and shell.poll() is None:
    if glob.glob(file):
        break
    time.sleep(0.01)
time.sleep(float(wait))
os.killpg(shell.pid, getattr(signal, name))
print('ended', shell.wait())
)";

class CliLoop : public Cli {
protected:
    void SetUp() override {
        write("slow.yaml",
              "foam: 1\nname: slow\nrobot: {urdf: ['" FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf']}\n"
              "stages: [spherize.cover: {}]\nbudget: {spheres: 400}\n"
              "outputs: [write.csv: {file: s.csv}]\nsnapshots: {size: [1280, 960]}\n");
    }

    Outcome loop(const std::string& command, const std::string& file, const std::string& signal,
                 const std::string& wait, const std::string& rounds = "1 2") const {
        write("loop.sh", "trap '' TERM\nfor round in " + rounds +
                             "; do echo round $round; (trap - TERM; exec '" FOAM_TEST_BINARY "' " + command +
                             ") >loop.out 2>loop.err; echo code $?; done\n");
        write("interrupt.py", interrupt_group);
        return shell("python3 interrupt.py '" + file + "' " + signal + " " + wait + " && cat rounds");
    }
};

TEST_F(CliLoop, AnInterruptEndsTheShellsLoop) {
    const Outcome outcome = loop("run slow.yaml --fresh", "loop.err", "SIGINT", "1");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "ended -2\nround 1\n") << contents(path() / "loop.err");
}

TEST_F(CliLoop, ATerminationExitsWith130) {
    const Outcome outcome = loop("run slow.yaml --fresh", "loop.err", "SIGTERM", "1", "1");
    EXPECT_THAT(outcome.out, HasSubstr("round 1\ncode 130\n")) << contents(path() / "loop.err");
}

/// When all is found, a run is finished: it is a cut all the same.
TEST_F(CliLoop, SoDoesOneInTheLastPhase) {
    write("slow.yaml",
          "foam: 1\nname: slow\nrobot: {urdf: ['" FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf']}\n"
          "stages: [spherize.grid: {}]\n"
          "outputs: [write.csv: {file: s.csv}]\nsnapshots: {size: [1280, 960]}\ndebug: {snapshots: true}\n");
    const Outcome outcome = loop("run slow.yaml --fresh", "runs/.slow.partial-*/snapshots/robot.png", "SIGINT", "0");
    EXPECT_EQ(outcome.out, "ended -2\nround 1\n") << contents(path() / "loop.err");
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/slow/manifest.json")) << contents(path() / "loop.err");
}

TEST_F(CliLoop, OtherCommandsEndAsWell) {
    const std::string robot = "'" FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf'";
    ASSERT_EQ(foam("spherize " + robot + " --method grid -o s.urdf").code, 0);
    std::string models;
    for (int i = 0; i < 40; ++i) {
        models += " s.urdf";
    }
    for (const std::string& command : {"compare " + robot + models, "self-collision " + robot + " --samples 1000000000",
                                       "spherize " + robot + " -n 400 -o t.urdf"}) {
        const Outcome outcome = loop(command, "loop.err", "SIGINT", "0.3");
        EXPECT_EQ(outcome.out, "ended -2\nround 1\n") << command << contents(path() / "loop.err");
    }
}

/// What the user asked for is no cut by the user.
TEST_F(CliLoop, ATimeLimitEndsWellAndWarns) {
    const Outcome outcome = foam("run slow.yaml --fresh --time-limit 0.5 --set snapshots=false");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning"));
}

} // namespace
} // namespace foam::test
