// One meaning of -o in all commands, and the folder of a run.
#include "program.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

constexpr const char* box_recipe = R"(foam: 1
mesh: box.obj
stages:
  - spherize.grid
budget: {spheres: 2}
outputs:
  - write.csv
)";

class RunFolder : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("box.yaml", box_recipe);
    }
};

TEST_F(RunFolder, IsNamedByOneOptionInAllCommands) {
    ASSERT_EQ(foam("run box.yaml --run-dir run").code, 0);
    EXPECT_TRUE(fs::exists(path() / "run/manifest.json"));
    ASSERT_EQ(foam("spherize box.obj -n 2 -m grid -o box.csv --run-dir spherized").code, 0);
    EXPECT_TRUE(fs::exists(path() / "spherized/manifest.json"));
    ASSERT_EQ(foam("approximate box.obj -n 2 --effort fast -o box.json --run-dir approximated").code, 0);
    EXPECT_TRUE(fs::exists(path() / "approximated/manifest.json"));
    ASSERT_EQ(foam("batch '*.obj' -n 2 -m grid --run-dir set").code, 0);
    EXPECT_TRUE(fs::exists(path() / "set/index.html"));
}

TEST_F(RunFolder, OldSpellingWorksAndIsNotShown) {
    ASSERT_EQ(foam("run box.yaml --out run").code, 0);
    EXPECT_TRUE(fs::exists(path() / "run/manifest.json"));
    ASSERT_EQ(foam("spherize box.obj -n 2 -m grid -o box.csv --out spherized").code, 0);
    EXPECT_TRUE(fs::exists(path() / "spherized/manifest.json"));
    ASSERT_EQ(foam("batch '*.obj' -n 2 -m grid --out=set").code, 0);
    EXPECT_TRUE(fs::exists(path() / "set/index.html"));
    for (const char* command : {"run", "spherize", "approximate", "batch", "bench"}) {
        const std::string help = foam(std::string(command) + " --help").out;
        EXPECT_THAT(help, HasSubstr("--run-dir DIR")) << command;
        EXPECT_THAT(help, Not(HasSubstr("--out "))) << command;
        EXPECT_THAT(help, Not(HasSubstr("--out,"))) << command;
    }
}

TEST_F(RunFolder, BothSpellingsAtOnceAreAnError) {
    const Outcome outcome = foam("run box.yaml --out one --run-dir two");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: error: --out is the old spelling of --run-dir; remedy: one of the two\n");
}

TEST_F(RunFolder, OutputFileOfACommandThatWritesAFolderNamesTheRemedy) {
    for (const char* arguments : {"run box.yaml -o here", "run -o here box.yaml", "run box.yaml --output here"}) {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(outcome.err,
                  "foam: error: -o names an output file, and foam run writes a folder; remedy: --run-dir here\n")
            << arguments;
    }
    EXPECT_THAT(foam("run box.yaml -o").err, HasSubstr("remedy: --run-dir DIR\n"));
    EXPECT_EQ(foam("bench speed.yaml -o here").err,
              "foam: error: -o names an output file, and foam bench writes a folder; remedy: --run-dir here\n");
    const Outcome batch = foam("batch '*.obj' -n 2 -o here");
    EXPECT_EQ(batch.code, 2);
    EXPECT_EQ(batch.err, "foam: error: -o names the table of foam batch collect; remedy: --run-dir here\n");
    EXPECT_FALSE(fs::exists(path() / "here"));
}

} // namespace
} // namespace foam::test
