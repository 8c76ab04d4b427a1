// Other people's meshes: every one gives sound spheres, however broken.
#include "fixture.hpp"
#include "support/shared_folder.hpp"

#include <foam/base/error.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

using namespace foam;
using namespace foam::test;

namespace {

void spherize_all(const std::filesystem::path& folder, std::uintmax_t largest_file) {
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << folder << " is not there";
    }
    Registry registry;
    ASSERT_TRUE(registry.load(FOAM_TEST_PLUGINS "/spherize_medial.so").loaded());
    if (!registry.load(FOAM_TEST_PLUGINS "/load_mesh.so").loaded()) {
        GTEST_SKIP() << "no loader";
    }
    const auto loader = registry.make<MeshLoader>("load.mesh");
    const auto stage = registry.make<Spherizer>("spherize.medial");
    std::size_t done = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        std::string extension = entry.path().extension().string();
        extension.erase(0, 1);
        if (!entry.is_regular_file() || entry.file_size() > largest_file ||
            registry.find_for_extension(StageKind::mesh_loader, extension) == nullptr) {
            continue;
        }
        SCOPED_TRACE(entry.path().string());
        QuietContext context;
        std::shared_ptr<const Solid> solid;
        try {
            solid = Solid::make(loader->load(entry.path(), context));
        } catch (const Error&) {
            continue; // the loader's own tests say what is an error
        }
        const std::vector<Budget> budgets{at_most(1), at_most(6)};
        try {
            const Shape shape(entry.path().filename(), solid, solid);
            for (const SphereTree& tree : stage->search(shape)->at_most(budgets, context)) {
                ASSERT_GE(tree.finest().size(), 1u);
                ASSERT_LE(tree.finest().size(), 6u);
                for (const Sphere& sphere : tree.finest()) {
                    ASSERT_TRUE(is_finite(sphere.center) && std::isfinite(sphere.radius) && sphere.radius > 0);
                }
                EXPECT_LT(largest_gap(*solid, tree.finest()), 0.02 * solid->bounds().diagonal());
            }
            ++done;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::geometry) << error.what();
        }
    }
    EXPECT_GT(done, 5u);
}

} // namespace

TEST(SpherizeMedialCorpus, SyntheticMeshesWithDefects) {
    spherize_all(shared_folder() / "meshes" / "synthetic", 1 << 20);
}

TEST(SpherizeMedialCorpus, RealMeshes) {
    spherize_all(shared_folder() / "meshes" / "real", 300 << 10);
}

TEST(SpherizeMedialCorpus, PandaWithinTheBudgetOfTheOriginal) {
    // Equal counts, two spheres a link: the original tool reaches 1.21 with 22 shared out freely.
    const auto folder = shared_folder() / "robots/panda/moveit_resources_panda_description/meshes/collision";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << folder << " is not there";
    }
    Registry registry;
    if (!registry.load(FOAM_TEST_PLUGINS "/load_mesh.so").loaded()) {
        GTEST_SKIP() << "no loader";
    }
    const auto loader = registry.make<MeshLoader>("load.mesh");
    double outside = 0, volume = 0;
    for (const char* name :
         {"link0", "link1", "link2", "link3", "link4", "link5", "link6", "link7", "hand", "finger", "finger"}) {
        QuietContext context;
        const Mesh mesh = loader->load(folder / (std::string(name) + ".stl"), context);
        const double solid_volume = Solid::make(mesh)->volume();
        outside += excess(mesh, spheres(mesh, 2)) * solid_volume;
        volume += solid_volume;
    }
    EXPECT_LT(outside / volume, 1.05);
}
