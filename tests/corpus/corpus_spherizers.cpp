// Every spherizer on every link of the shared robots as they are, without repair: tiny, flat, open and broken ones too.
#include "corpus/mesh_files.hpp"
#include "corpus/whole_run.hpp"
#include "spherize/all_spherizers.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace foam {
namespace {

namespace fs = std::filesystem;

using Case = std::tuple<std::string, std::string>;
class CorpusSpherizer : public ::testing::TestWithParam<Case> {};

TEST_P(CorpusSpherizer, CoversEveryLinkWithFourSpheres) {
    const auto& [robot, spherizer] = GetParam();
    const fs::path file = shared_folder() / "robots" / robot;
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const TemporaryFolder folder;
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    const RunResult result = run_text("robot: {urdf: '" + file.string() + "'}\nstages: [" + spherizer +
                                          ", refine.row, refine.split]\nlinks: {'*': {max_spheres: 4}}\n",
                                      registry, folder.path() / "out");
    EXPECT_TRUE(result.certified);
    EXPECT_FALSE(result.links_lost);
    for (const LinkReport& link : result.links) {
        EXPECT_TRUE(link.error.empty()) << link.link << ": " << link.error;
        EXPECT_TRUE(link.measures.certified) << link.link;
        EXPECT_LE(link.measures.spheres, 4u) << link.link;
    }
    std::cout << robot << ", " << spherizer << ": " << result.total.spheres << " spheres, excess "
              << result.total.excess << ", " << result.cpu_seconds << " CPU seconds\n";
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusSpherizer,
                         ::testing::Combine(::testing::ValuesIn(one_model_of_each_robot()),
                                            ::testing::ValuesIn(test::spherizer_names())),
                         [](const auto& test) {
                             const std::string& robot = std::get<0>(test.param);
                             return name_of_case(robot.substr(0, robot.find('/')) + " " + std::get<1>(test.param));
                         });

} // namespace
} // namespace foam
