// Every mesh of the shared folder: spheres with a proof, or an error that names the file. Never a crash, never a hang.
#include "corpus/mesh_files.hpp"
#include "corpus/whole_run.hpp"
#include "support/shared_folder.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/error.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> mesh_files() {
    return mesh_files_below(shared_folder() / "meshes");
}

class CorpusMesh : public ::testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CorpusMesh);

TEST_P(CorpusMesh, GivesSpheresOrAClearError) {
    const fs::path file = shared_folder() / "meshes" / GetParam();
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const TemporaryFolder folder;
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    try {
        const RunResult result = spherized(registry, file, 8, folder.path() / "out");
        EXPECT_FALSE(unreadable_meshes().contains(GetParam())) << "no error for a file that holds no mesh";
        EXPECT_TRUE(result.certified);
        EXPECT_GE(result.total.spheres, 1u);
        EXPECT_LE(result.total.spheres, 8u);
        EXPECT_EQ(result.total.gap, 0);
        std::printf("%s: %zu spheres, excess %.3f, %.2f s\n", GetParam().c_str(), result.total.spheres,
                    result.total.excess, result.seconds);
    } catch (const Error& error) {
        EXPECT_TRUE(unreadable_meshes().contains(GetParam())) << error.what();
        EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
        EXPECT_FALSE(fs::exists(folder.path() / "out"));
        std::printf("%s: %s\n", GetParam().c_str(), error.what());
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, CorpusMesh, ::testing::ValuesIn(mesh_files()),
                         [](const auto& file) { return name_of_case(file.param); });

TEST(CorpusMeshes, AreThere) {
    if (mesh_files().empty()) {
        GTEST_SKIP() << "no meshes in " << shared_folder() << "; set FOAM_SHARED";
    }
    SUCCEED();
}

} // namespace
} // namespace foam
