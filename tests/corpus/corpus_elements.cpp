// Every kind of element around every shared mesh, and around the links of every shared robot.
#include "corpus/mesh_files.hpp"
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>

namespace foam {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> approximators{"capsules", "boxes", "swept_boxes", "cylinders", "hulls", "mixed"};

/// Returns the result with at most `most` elements on each link.
RunResult approximated(const std::string& input, const std::string& by, std::size_t most, const fs::path& out) {
    static Registry& registry = *[] {
        auto* loaded = new Registry;
        loaded->load_directory(FOAM_TEST_PLUGINS);
        return loaded;
    }();
    const std::string kinds = by == "mixed" ? ", kinds: 'sphere, capsule, box, hull'" : "";
    return run_text(input + "stages: [approximate." + by + ": {effort: fast, objective: excess" + kinds +
                        "}]\nlinks: {'*': {max_spheres: " + std::to_string(most) + "}}\n",
                    registry, out);
}

class CorpusElementsOfMesh : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CorpusElementsOfMesh);

TEST_P(CorpusElementsOfMesh, AreProvedOrThereIsAClearError) {
    const fs::path file = shared_folder() / "meshes" / GetParam();
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    for (const std::string& by : approximators) {
        SCOPED_TRACE(by);
        const TemporaryFolder folder;
        try {
            const RunResult result = approximated("mesh: '" + file.string() + "'\n", by, 3, folder.path() / "out");
            EXPECT_FALSE(unreadable_meshes().contains(GetParam())) << "no error for a file that holds no mesh";
            EXPECT_TRUE(result.certified);
            EXPECT_EQ(result.total.gap, 0);
            EXPECT_GE(result.total.spheres, 1u);
            EXPECT_LE(result.total.spheres, 3u);
            std::cout << by << ": excess " << result.total.excess << ", " << result.cpu_seconds << " CPU seconds\n";
        } catch (const Error& error) {
            EXPECT_TRUE(unreadable_meshes().contains(GetParam())) << error.what();
            EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
            EXPECT_FALSE(fs::exists(folder.path() / "out"));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusElementsOfMesh,
                         ::testing::ValuesIn(mesh_files_below(shared_folder() / "meshes")),
                         [](const auto& file) { return name_of_case(file.param); });

using Case = std::tuple<std::string, std::string>;
class CorpusElementsOfRobot : public ::testing::TestWithParam<Case> {};

TEST_P(CorpusElementsOfRobot, AreProvedAndMoreAreNoWorse) {
    const auto& [robot, by] = GetParam();
    const fs::path file = shared_folder() / "robots" / robot;
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    std::map<std::string, double> least; // by link
    // Of a link. More of them take many minutes.
    const std::vector<std::size_t> budgets =
        std::getenv("FOAM_TEST_LONG") ? std::vector<std::size_t>{1, 2, 4, 8} : std::vector<std::size_t>{1, 2};
    for (const std::size_t most : budgets) {
        const TemporaryFolder folder;
        const RunResult result =
            approximated("robot: {urdf: '" + file.string() + "'}\n", by, most, folder.path() / "out");
        EXPECT_TRUE(result.certified);
        EXPECT_FALSE(result.links_lost);
        for (const LinkReport& link : result.links) {
            EXPECT_TRUE(link.error.empty()) << link.link << ": " << link.error;
            EXPECT_TRUE(link.measures.certified) << link.link;
            EXPECT_LE(link.measures.spheres, most) << link.link;
            const auto [known, first] = least.emplace(link.link, link.measures.excess);
            constexpr double accuracy = 2e-3; // of the volume of the union
            EXPECT_LE(link.measures.excess, known->second + accuracy * (1 + known->second))
                << link.link << " by " << most;
            known->second = std::min(known->second, link.measures.excess);
        }
        std::cout << robot << ", " << by << ": " << result.total.spheres << " elements, excess " << result.total.excess
                  << ", " << result.cpu_seconds << " CPU seconds\n";
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusElementsOfRobot,
                         ::testing::Combine(::testing::ValuesIn(one_model_of_each_robot()),
                                            ::testing::ValuesIn(approximators)),
                         [](const auto& test) {
                             const std::string& robot = std::get<0>(test.param);
                             return name_of_case(robot.substr(0, robot.find('/')) + " " + std::get<1>(test.param));
                         });

} // namespace
} // namespace foam
