// What a user is told of each bad plugin, by the loader and by `foam plugins --why`; the good ones are loaded all the
// same.
#include "cli/program.hpp"

#include <foam/runtime/process.hpp>
#include <foam/sdk/registry.hpp>

#include <algorithm>
#include <csignal>
#include <regex>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path sources = fs::path(FOAM_TEST_SOURCE) / "tests/plugin/bad";
const fs::path built = FOAM_TEST_BAD_PLUGINS;

/// Names of tests/plugin/bad.
std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(sources)) {
        if (entry.path().extension() == ".cpp") {
            result.push_back(entry.path().stem().string());
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

std::string file_name(const std::string& name) {
    return (built / ("bad_" + name + ".so")).string();
}

/// A message without the folder that the plugins were built in, and without digests of layouts.
std::string without_folder(std::string text) {
    text = std::regex_replace(text, std::regex("ABI layout [0-9a-f]{16}"), "ABI layout DIGEST");
    const std::string folder = fs::canonical(built).string() + "/";
    for (std::size_t at = 0; (at = text.find(folder)) != text.npos;) {
        text.erase(at, folder.size());
    }
    return text;
}

TEST(RefusedPlugins, HaveExactlyTheirMessages) {
    EXPECT_GE(names().size(), 28U);
    for (const std::string& name : names()) {
        SCOPED_TRACE(name);
        Registry registry;
        ASSERT_TRUE(registry.load(std::string(FOAM_TEST_FIXTURES) + "/fixture_stages.so").loaded());
        const std::size_t stages = registry.stages().size();
        const std::string message = without_folder(registry.load(file_name(name)).rejection) + "\n";
        const fs::path expected = sources / (name + ".expected");
        if (std::getenv("FOAM_TEST_UPDATE")) {
            std::ofstream(expected, std::ios::binary) << message;
        }
        EXPECT_EQ(message, contents(expected));
        EXPECT_EQ(registry.stages().size(), stages) << "it left stages behind";
    }
}

/// Without the program that a plugin for another foam would end.
TEST(RefusedPlugins, DeadlyOnesAreToldApart) {
    const auto why = [](const std::string& name, double seconds = 60) {
        return why_loading_ends_badly(FOAM_TEST_BINARY, FOAM_TEST_DEADLY_PLUGINS + ("/deadly_" + name + ".so"),
                                      seconds);
    };
    constexpr const char* remedy = "; remedy: correct its entry point and the constructors of its static objects";
    EXPECT_EQ(why("exits"), std::string("it ends the program while it is loaded (exit code 7)") + remedy);
    EXPECT_EQ(why("loops", 1), std::string("loading it did not end within 1 s") + remedy);
    EXPECT_EQ(why_loading_ends_badly(FOAM_TEST_BINARY, file_name("no_stages")), "");
    EXPECT_EQ(why_loading_ends_badly(FOAM_TEST_BINARY, "/there/is/no/such.so"), "");
    if (std::string(FOAM_ABI_SANITIZER) == "none") { // a sanitizer ends the process in its own way
        EXPECT_EQ(why("crashes"),
                  std::string("it crashes while it is loaded (SIGSEGV, invalid memory access or stack overflow)") +
                      remedy);
        EXPECT_EQ(why("aborts"), std::string("it crashes while it is loaded (SIGABRT, the program aborted)") + remedy);
    }
}

class RefusedPluginsCli : public Cli {};

TEST_F(RefusedPluginsCli, WhyShowsEach) {
    const Outcome outcome =
        foam("plugins --plugin '" FOAM_TEST_FIXTURES "/fixture_stages.so' --plugin-dir '" + built.string() + "' --why");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = without_folder(outcome.out);
    for (const std::string& name : names()) {
        EXPECT_THAT(text, HasSubstr("bad_" + name + ".so\n  refused: " + contents(sources / (name + ".expected"))));
    }
    EXPECT_THAT(text, HasSubstr("load_mesh"));
    EXPECT_THAT(text, HasSubstr("fixture_stages"));
}

TEST_F(RefusedPluginsCli, TheOthersAreLoaded) {
    const Outcome outcome = foam("stages --plugin-dir '" + built.string() + "'");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("load.mesh"));
    for (const std::string& name : names()) {
        if (name != "taken") { // its stage is another's only if that is there
            EXPECT_THAT(outcome.err, HasSubstr("bad_" + name + ".so is refused: "));
        }
    }
}

TEST_F(RefusedPluginsCli, OneThatCrashesDoesNotEndTheListing) {
    fs::create_directory(path() / "mine");
    for (const char* name : {"deadly_aborts.so", "deadly_crashes.so", "deadly_exits.so"}) {
        fs::create_symlink(fs::path(FOAM_TEST_DEADLY_PLUGINS) / name, path() / "mine" / name);
    }
    const Outcome outcome = foam("plugins --plugin-dir mine --why");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("load_mesh"));
    EXPECT_THAT(outcome.out,
                HasSubstr("deadly_exits.so\n  refused: it ends the program while it is loaded (exit code 7)"));
    EXPECT_THAT(outcome.out, HasSubstr("deadly_aborts.so\n  refused: it "));
    EXPECT_THAT(outcome.out, HasSubstr("deadly_crashes.so\n  refused: it "));
}

/// Elsewhere plugins are loaded at once; the crash names the one at fault.
TEST_F(RefusedPluginsCli, OneThatCrashesIsNamed) {
    if (std::string(FOAM_ABI_SANITIZER) != "none") {
        GTEST_SKIP() << "a sanitizer ends the process in its own way";
    }
    const fs::path file = fs::canonical(FOAM_TEST_DEADLY_PLUGINS) / "deadly_aborts.so";
    const Outcome outcome = foam("stages --plugin '" + file.string() + "'");
    EXPECT_EQ(outcome.code, 128 + SIGABRT);
    EXPECT_THAT(
        outcome.err,
        HasSubstr("\nfoam: crashed (SIGABRT, the program aborted) in plugin " + file.string() +
                  ", while it was loaded\n"
                  "foam: the run directory is as it was before\n"
                  "foam: remedy: remove that plugin; `foam plugins --why` tests each plugin in a child process\n"));
}

} // namespace
} // namespace foam::test
