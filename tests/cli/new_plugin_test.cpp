// new-plugin: what it refuses. That its projects build and pass is tested in tests/sdk.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(Cli, NewPluginWritesAWholeProject) {
    const Outcome outcome = foam("new-plugin smooth.very_mine --dir 'my plugin'");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("my plugin is written. Next:\n  cmake -S 'my plugin' -B 'my plugin/build' "));
    for (const char* file : {"CMakeLists.txt", "README.md", "plugin.cpp", "test.cpp", "recipe.yaml", "compare.yaml",
                             "part.obj", ".gitignore"}) {
        EXPECT_TRUE(std::filesystem::exists(path() / "my plugin" / file)) << file;
    }
    EXPECT_FALSE(std::filesystem::exists(path() / "my plugin/more.md"));
    const std::string source = contents(path() / "my plugin/plugin.cpp");
    EXPECT_THAT(source, HasSubstr("class VeryMineFilter final"));
    EXPECT_THAT(source, HasSubstr("FOAM_PLUGIN(\"smooth_very_mine\", \"0.1\", \"Apache-2.0\")"));
}

TEST_F(Cli, NewPluginRefusesBadNames) {
    const auto refusal = [&](const std::string& name) {
        const Outcome outcome = foam("new-plugin '" + name + "'");
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    };
    EXPECT_EQ(refusal("sphereize.mine"),
              "foam: error: unknown kind 'sphereize'; did you mean 'spherize.mine'?; there are: "
              "load, read, refine, repair, simplify, smooth, spherize, write\n");
    EXPECT_EQ(refusal("mine"),
              "foam: error: 'mine' is not of the form kind.method (lower-case letters, digits, _), e.g. "
              "spherize.mine\n");
    EXPECT_THAT(refusal("spherize.Mine"), HasSubstr("is not of the form kind.method"));
    EXPECT_THAT(refusal("spherize.../mine"), HasSubstr("is not of the form kind.method"));
    EXPECT_EQ(
        refusal("spherize.octree"),
        "foam: error: there is a stage 'spherize.octree' already, from plugin spherize_octree; remedy: another name\n");
}

TEST_F(Cli, NewPluginLeavesWhatIsThereAlone) {
    std::filesystem::create_directory(path() / "spherize_mine");
    const Outcome outcome = foam("new-plugin spherize.mine");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: error: spherize_mine: it exists already; remedy: another folder by --dir\n");
    EXPECT_TRUE(std::filesystem::is_empty(path() / "spherize_mine"));
    EXPECT_EQ(foam("new-plugin spherize.mine --dir none/mine").err,
              "foam: error: cannot write to the folder " + (std::filesystem::canonical(path()) / "none").string() +
                  " (No such file or directory); remedy: name another one\n");
    EXPECT_FALSE(std::filesystem::exists(path() / "none"));
}

TEST_F(Cli, SdkSaysWhereItIs) {
    const Outcome outcome = foam("sdk");
    EXPECT_EQ(outcome.code, 0);
    std::string prefix = outcome.out;
    prefix.pop_back();
    EXPECT_TRUE(std::filesystem::exists(prefix + "/lib/cmake/foam/foamConfig.cmake")) << prefix;
}

} // namespace
} // namespace foam::test
