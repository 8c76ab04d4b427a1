// Every robot of the shared folder: sixty spheres, no crash, no lost link, cover proved on the written files.
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace foam {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> robot_files() {
    std::vector<std::string> files;
    std::error_code absent;
    for (const auto& entry : fs::recursive_directory_iterator(shared_folder() / "robots", absent)) {
        if (entry.path().extension() == ".urdf") {
            files.push_back(fs::relative(entry.path(), shared_folder() / "robots").string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

class CorpusRobot : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CorpusRobot);

TEST_P(CorpusRobot, IsCoveredBySixtySpheres) {
    const fs::path file = shared_folder() / "robots" / GetParam();
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const TemporaryFolder folder;
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    const RunResult result = spherized(registry, file, 60, folder.path() / "out");
    EXPECT_TRUE(result.certified);
    EXPECT_FALSE(result.links_lost);
    EXPECT_LE(result.total.spheres, 60u);
    EXPECT_GE(result.total.spheres, 57u) << "links that are alike get equal numbers";
    EXPECT_EQ(result.total.gap, 0);
    for (const LinkReport& link : result.links) {
        EXPECT_GE(link.measures.spheres, 1u) << link.link;
        EXPECT_TRUE(link.measures.certified) << link.link;
        EXPECT_TRUE(link.error.empty()) << link.link << ": " << link.error;
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusRobot, ::testing::ValuesIn(robot_files()), [](const auto& name) {
    std::string text = name.param;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return text;
});

TEST(CorpusRobots, AreThere) {
    if (robot_files().empty()) {
        GTEST_SKIP() << "no robots in " << shared_folder() << "; set FOAM_SHARED";
    }
    SUCCEED();
}

} // namespace
} // namespace foam
