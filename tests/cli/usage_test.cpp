// What the program says to a wrong command line, and its help.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Cli, NoArgumentsPrintTheHelpForPeople) {
    const Outcome outcome = foam("");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("Usage: foam [OPTIONS] SUBCOMMAND"));
}

TEST_F(Cli, UnknownCommand) {
    const Outcome outcome = foam("rum recipe.yaml");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err,
              "foam: unknown command 'rum'; did you mean 'run'?\nfoam: `foam --help` says how to use it\n");
}

TEST_F(Cli, UnknownCommandThatIsNearNothing) {
    EXPECT_EQ(foam("frobnicate").err, "foam: unknown command 'frobnicate'\nfoam: `foam --help` says how to use it\n");
}

TEST_F(Cli, UnknownOption) {
    const Outcome outcome = foam("stages --jsno");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err,
              "foam: unknown option '--jsno'; did you mean '--json'?\nfoam: `foam stages --help` says how to use it\n");
}

TEST_F(Cli, MissingAndSurplusArguments) {
    const Outcome missing = foam("run");
    EXPECT_EQ(missing.code, 2);
    EXPECT_THAT(missing.err, HasSubstr("recipe is required"));
    const Outcome surplus = foam("check a.yaml b.yaml");
    EXPECT_EQ(surplus.code, 2);
    EXPECT_THAT(surplus.err, HasSubstr("'b.yaml' is one argument too many"));
}

TEST_F(Cli, ValuesOutOfBounds) {
    for (const char* arguments : {"run a.yaml -j 0", "run a.yaml -j many", "spherize a.stl -n 0",
                                  "spherize a.stl -n -3", "stages --plugin-dir no_such_folder"}) {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_THAT(outcome.err, StartsWith("foam: ")) << arguments;
    }
}

TEST_F(Cli, SettingWithoutValue) {
    write("r.yaml", "foam: 1\n");
    const Outcome outcome = foam("check r.yaml --set budget.spheres");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: error: --set expects key.path=value, got 'budget.spheres'\n");
}

TEST_F(Cli, EveryCommandHasHelpWithExamples) {
    for (const char* command :
         {"run", "check", "spherize", "verify", "bench", "stages", "describe", "plugins", "schema", "version"}) {
        const Outcome outcome = foam(std::string(command) + " --help");
        EXPECT_EQ(outcome.code, 0) << command;
        EXPECT_EQ(outcome.err, "") << command;
        EXPECT_THAT(outcome.out, HasSubstr(std::string("Usage: foam ") + command));
        EXPECT_THAT(outcome.out, HasSubstr(std::string("Examples:\n  foam ") + command));
    }
    const Outcome all = foam("--help");
    EXPECT_EQ(all.code, 0);
    EXPECT_THAT(all.out, HasSubstr("Exit codes: 0 done"));
}

TEST_F(Cli, Version) {
    const Outcome outcome = foam("--version");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, ::testing::MatchesRegex("foam [0-9]+\\.[0-9]+\\.[0-9]+\n"));
    EXPECT_EQ(outcome.err, "");
}

TEST_F(Cli, FullStandardOutputIsAnError) {
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' stages >/dev/full");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "foam: error: cannot write to the standard output\n");
}

} // namespace
} // namespace foam::test
