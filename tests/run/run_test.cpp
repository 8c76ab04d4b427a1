// Whole runs on small robots: what comes out, and that it is the same every time.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(Run, WritesACertifiedRobotWithinItsBudget) {
    const RunResult result = run(recipe("stages: [spherize.grid]\nbudget: {spheres: 12}\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.total.spheres, 12u);
    EXPECT_EQ(result.total.gap, 0);
    const auto writer = registry.make<Writer>("write.urdf");
    const auto spheres = test::read_spheres(*writer, read_file(folder.path() / "out/two.urdf"));
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(spheres.at("base").size() + spheres.at("tip").size(), 12u);
    for (const char* file : {"two.json", "manifest.json", "events.jsonl", "recipe.resolved.yaml"}) {
        EXPECT_TRUE(fs::exists(folder.path() / "out" / file)) << file;
    }
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<!-- the base -->"));
}

TEST_F(Run, SkippedLinksKeepTheirGeometry) {
    const RunResult result = run(recipe("stages: [spherize.grid]\nlinks: {tip: {skip: true}}\n"), registry, options());
    EXPECT_TRUE(result.links[1].skipped);
    EXPECT_FALSE(result.links_lost);
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<cylinder"));
}

TEST_F(Run, SameBytesOnOneAndFourThreads) {
    for (const std::string budget :
         {"{spheres: 20}", "{excess: 0.9}", "{spheres: 30, excess: 0.9, max_protrusion: 0.05}"}) {
        const Recipe r = recipe("stages: [spherize.octree]\nself_collision: true\nbudget: " + budget + "\n");
        RunOptions one = options("one"), four = options("four");
        one.threads = 1;
        four.threads = 4;
        run(r, registry, one);
        run(r, registry, four);
        for (const char* file : {"two.urdf", "two.json"}) {
            EXPECT_EQ(read_file(folder.path() / "one" / file), read_file(folder.path() / "four" / file))
                << file << budget;
        }
    }
}

TEST_F(Run, TheResolvedRecipeGivesTheSameBytes) {
    run(recipe("stages: [spherize.grid]\nbudget: {spheres: 9}\n"), registry, options("first"));
    const auto resolved = read_recipe(folder.path() / "first/recipe.resolved.yaml", registry);
    ASSERT_TRUE(resolved.ok()) << (resolved.diagnostics.empty() ? "" : resolved.diagnostics[0].text());
    run(resolved.recipes.at(0), registry, options("second"));
    EXPECT_EQ(read_file(folder.path() / "first/two.urdf"), read_file(folder.path() / "second/two.urdf"));
}

} // namespace
} // namespace foam
