// What the program says to a wrong command line, and its help.
#include "program.hpp"

#include <algorithm>
#include <sstream>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
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
    EXPECT_EQ(outcome.err, "foam: unknown command 'rum'; did you mean 'run'?\nfoam: `foam --help` explains its use\n");
}

TEST_F(Cli, UnknownCommandThatIsNearNothing) {
    EXPECT_EQ(foam("frobnicate").err, "foam: unknown command 'frobnicate'\nfoam: `foam --help` explains its use\n");
}

TEST_F(Cli, UnknownOption) {
    const Outcome outcome = foam("stages --jsno");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err,
              "foam: unknown option '--jsno'; did you mean '--json'?\nfoam: `foam stages --help` explains its use\n");
}

TEST_F(Cli, MissingAndSurplusArguments) {
    const Outcome missing = foam("run");
    EXPECT_EQ(missing.code, 2);
    EXPECT_THAT(missing.err, HasSubstr("recipe is required"));
    const Outcome surplus = foam("check a.yaml b.yaml");
    EXPECT_EQ(surplus.code, 2);
    EXPECT_THAT(surplus.err, HasSubstr("'b.yaml' is one argument too many"));
}

TEST_F(Cli, OptionsLeaveTheFileAfterThem) {
    write("part.stl", "solid part\nendsolid part\n");
    for (const char* arguments :
         {"approximate --with capsule,box part.stl -n 4", "approximate --cost 4 --costs capsule=2,box=3 part.stl",
          "approximate --with capsule --with box part.stl -n 4", "spherize --set effort=fast part.stl -n 4"}) {
        const Outcome outcome = foam(arguments);
        EXPECT_THAT(outcome.err, HasSubstr("part.stl")) << arguments;
        EXPECT_THAT(outcome.err, Not(HasSubstr("required"))) << arguments;
    }
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

/// A number that is none, or makes no sense, is refused with the range for people.
TEST_F(Cli, NumbersOfOptionsAreCheckedAlike) {
    write("t.obj", box_obj);
    const std::pair<const char*, const char*> cases[] = {
        {"spherize t.obj -n 3 --time-limit nan", "--time-limit: expects a finite number above 0, got 'nan'"},
        {"spherize t.obj -n 3 --time-limit inf", "--time-limit: expects a finite number above 0, got 'inf'"},
        {"spherize t.obj -n 3 --scale abc", "--scale: expects a finite number above 0, got 'abc'"},
        {"spherize t.obj --excess nan", "--excess: expects a finite number of at least 0, got 'nan'"},
        {"spherize t.obj -n 3 --seed -1", "--seed: expects a whole number of at least 0, got '-1'"},
        {"spherize t.obj -n 1e3", "--spheres: expects a whole number from 1 to 1000000, got '1e3'"},
        {"approximate t.obj --cost nan", "--cost: expects a finite number above 0, got 'nan'"},
        {"batch . -n 2 --run-dir s --time-limit nan", "--time-limit: expects a finite number above 0, got 'nan'"},
        {"batch . -n 2 --run-dir s --memory-limit -1",
         "--memory-limit: expects a whole number from 0 to 1000000000, got '-1'"},
        {"batch . -n 2 --run-dir s --shard -1", "--shard: expects a whole number from 0 to 999999, got '-1'"},
        {"self-collision t.urdf --confidence nan", "--confidence: expects a number between 0 and 1, got 'nan'"},
        {"cache --trim -1", "--trim: expects a whole number from 0 to 1000000000, got '-1'"}};
    for (const auto& [arguments, words] : cases) {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_THAT(outcome.err, StartsWith("foam: ")) << arguments;
        EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
    }
}

/// As if redirected to /dev/null: files get no messages, and messages that nobody can read end nothing.
TEST_F(Cli, ClosedStreams) {
    write("t.obj", box_obj);
    for (const char* closed : {"2>&-", ">&-", "<&-", ">&- 2>&-", "<&- >&- 2>&-", "2>/dev/full"}) {
        std::filesystem::remove(path() / "t.json");
        EXPECT_EQ(foam(std::string("spherize t.obj -n 3 -m grid -o t.json --force ") + closed).code, 0) << closed;
        EXPECT_THAT(contents(path() / "t.json"), StartsWith("{")) << closed;
        EXPECT_EQ(foam(std::string("no_such_command ") + closed).code, 2) << closed;
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

/// The experiments are part of the Python package, which the first build does not make.
TEST_F(Cli, BenchThatIsNotBuilt) {
    namespace fs = std::filesystem;
    fs::create_directory(path() / "bin");
    fs::copy_file(FOAM_TEST_BINARY, path() / "bin/foam");
    const Outcome outcome = shell("bin/foam bench x.yaml --check");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: error: the Python package foam, which foam bench runs, is not beside " +
                               fs::canonical(path() / "bin").string() +
                               "; remedy: in a clone, run `./foam bench` once, which builds it; for an installed foam, "
                               "install the package python3-foam\n");
}

TEST_F(Cli, HelpFitsATerminalOf80Columns) {
    const std::string all = foam("--help").out;
    const std::size_t start = all.find("Subcommands:\n") + 13;
    std::istringstream entries(all.substr(start, all.find("\n\n", start) - start));
    std::vector<std::string> commands{""};
    for (std::string line; std::getline(entries, line);) {
        if (line.size() > 2 && line[2] != ' ') {
            commands.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
    }
    ASSERT_EQ(commands.size(), 30U);
    for (const std::string& command : commands) {
        std::istringstream help(foam(command + " --help").out);
        for (std::string line; std::getline(help, line);) {
            const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
            EXPECT_LE(columns, 80) << command << ": " << line;
        }
    }
}

TEST_F(Cli, HelpShowsDefaultsAndExclusions) {
    EXPECT_THAT(foam("self-collision --help").out,
                HasSubstr("  --seed N                  Seed of the samples; default: 0\n"));
    EXPECT_THAT(foam("cache --help").out,
                HasSubstr("  --clear                   Delete all entries; not together with --trim\n"));
}

TEST_F(Cli, Version) {
    const Outcome outcome = foam("--version");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out,
                ::testing::MatchesRegex("foam [0-9]+\\.[0-9]+\\.[0-9]+ \\(.*(g\\+\\+|clang) [0-9.]+.*\\)\n"));
    EXPECT_EQ(outcome.err, "");
}

TEST_F(Cli, FullStandardOutputIsAnError) {
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' stages >/dev/full");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "foam: error: cannot write to the standard output\n");
}

} // namespace
} // namespace foam::test
