// foam cache, and the limit that runs keep.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using ::testing::MatchesRegex;

class CacheCommand : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("box.yaml", "foam: 1\nname: box\nmesh: box.obj\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
                          "outputs: [write.csv: {file: box.csv}]\n");
    }
    std::size_t entries() const { return nlohmann::json::parse(foam("cache --json").out)["entries"]; }
};

TEST_F(CacheCommand, SaysWhatItHoldsAndClearsIt) {
    ASSERT_EQ(foam("run box.yaml").code, 0);
    const std::string folder = (path() / "cache/foam").string();
    const Outcome held = foam("cache");
    EXPECT_EQ(held.code, 0) << held.err;
    EXPECT_THAT(held.out,
                MatchesRegex(folder + ": [1-9][0-9]* entries, [0-9]+\\.[0-9] MiB; runs leave at most 2048 MiB "
                                      "\\(FOAM_CACHE_LIMIT\\)\n"));
    EXPECT_GT(entries(), 0u);
    EXPECT_EQ(foam("cache --trim 500").out, held.out);
    EXPECT_THAT(foam("cache --clear").out,
                MatchesRegex(folder + ": 0 entries, 0\\.0 MiB; runs .*; deleted: [1-9][0-9]* entries, .*\n"));
    EXPECT_EQ(entries(), 0u);
    EXPECT_EQ(foam("cache --clear").code, 0);
    EXPECT_EQ(foam("cache --clear --trim 1").code, 2);
}

TEST_F(CacheCommand, RemovesWhatKilledRunsLeft) {
    ASSERT_EQ(shell("mkdir -p runs/.box.partial-1 runs/.mine && touch runs/.box.partial-1/.foam-unfinished "
                    "runs/.mine/.foam-unfinished runs/.box.partial-1/box.csv")
                  .code,
              0);
    EXPECT_THAT(foam("cache").err, ::testing::ContainsRegex("removed: [1-9][0-9]* unfinished folders? of killed runs\n"));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/.box.partial-1"));
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/.mine")) << "foam gives no folder this name";
}

TEST_F(CacheCommand, TheLimitOfRunsIsAWholeNumber) {
    for (const char* wrong : {"-1", "2G", "1.5", "99999999999999999999"}) {
        const std::string set = "FOAM_CACHE_LIMIT=" + std::string(wrong) + " '" FOAM_TEST_BINARY "' ";
        for (const char* command : {"cache", "run box.yaml"}) {
            const Outcome outcome = shell(set + command);
            EXPECT_EQ(outcome.code, 2) << command;
            EXPECT_THAT(outcome.err, ::testing::EndsWith("foam: error: FOAM_CACHE_LIMIT is '" + std::string(wrong) +
                                                         "'; remedy: a whole number of MiB, 0 for no limit\n"));
        }
    }
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/box"));
    EXPECT_EQ(shell("FOAM_CACHE_LIMIT=0 '" FOAM_TEST_BINARY "' run box.yaml").code, 0);
    EXPECT_THAT(shell("FOAM_CACHE_LIMIT=0 '" FOAM_TEST_BINARY "' cache").out,
                ::testing::HasSubstr("without a limit (FOAM_CACHE_LIMIT is 0)"));
}

} // namespace
} // namespace foam::test
