// Trees of depth 2 and more through a whole run: write.urdf takes any level, write.json has all with their parents, and
// each level on its own keeps the guarantee on the numbers that were written.
#include "all_spherizers.hpp"
#include "support/runs.hpp"

#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>

#include <nlohmann/json.hpp>

namespace {

using namespace foam;
using namespace foam::test;
using Json = nlohmann::json;

constexpr std::size_t levels = 3;

class WrittenTree : public RunTest, public testing::WithParamInterface<std::string> {
protected:
    WrittenTree() {
        write("part.obj",
              "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 1\nv 4 0 1\nv 4 1 1\nv 1 1 1\nv 1 3 1\n"
              "v 0 3 1\nf 6 5 4\nf 6 4 1\nf 4 3 2\nf 4 2 1\nf 7 10 11\nf 7 11 12\nf 7 8 9\nf 7 9 10\nf 1 2 8\nf 1 8 7\n"
              "f 2 3 9\nf 2 9 8\nf 3 4 10\nf 3 10 9\nf 4 5 11\nf 4 11 10\nf 5 6 12\nf 5 12 11\nf 6 1 7\nf 6 7 12\n");
        write("part.urdf",
              "<robot name=\"part\"><link name=\"part\"><collision><geometry><mesh filename=\"part.obj\"/></geometry>"
              "</collision></link></robot>");
    }

    RunResult run_with(const std::string& guarantee) {
        std::string text = "name: tree\nrobot: {urdf: part.urdf}\nstages: [" + GetParam() +
                           ": {depth: 2}]\nguarantee: " + guarantee + "\noutputs:\n  - write.json: {file: tree.json}\n";
        for (std::size_t level = 0; level < levels; ++level) {
            text +=
                "  - write.urdf: {file: " + std::to_string(level) + ".urdf, level: " + std::to_string(level) + "}\n";
        }
        return run(recipe_of(text), registry, options());
    }

    /// The levels as the JSON file has them; checks that the URDF files have the same.
    SphereTree read_levels() {
        const Json document = Json::parse(text_of("out/tree.json"));
        SphereTree tree;
        for (const Json& list : document["links"]["part"]["groups"][0]["levels"]) {
            SphereTree::Level& level = tree.levels.emplace_back();
            for (const Json& sphere : list) {
                const Json& c = sphere["center"];
                level.elements.spheres().push_back({{c[0], c[1], c[2]}, sphere["radius"]});
                if (sphere.contains("parent")) {
                    level.parents.push_back(sphere["parent"]);
                }
            }
            const std::size_t l = tree.levels.size() - 1;
            EXPECT_EQ(spheres_in("out/" + std::to_string(l) + ".urdf").at("part"), level.elements.spheres()) << "level " << l;
            EXPECT_EQ(level.parents.size(), l == 0 ? 0 : level.elements.spheres().size());
            for (const std::uint32_t parent : level.parents) {
                EXPECT_LT(parent, tree.levels[l - 1].elements.spheres().size());
            }
        }
        return tree;
    }
};

TEST_P(WrittenTree, EveryLevelCovers) {
    const RunResult result = run_with("outer");
    EXPECT_TRUE(result.certified);
    const SphereTree tree = read_levels();
    ASSERT_EQ(tree.levels.size(), levels);
    EXPECT_EQ(tree.levels[0].elements.spheres().size(), 1u);
    EXPECT_GT(tree.levels[2].elements.spheres().size(), tree.levels[1].elements.spheres().size());
    QuietContext context;
    const auto part = Solid::make(registry.make<MeshLoader>("load.mesh")->load(folder.path() / "part.obj", context));
    for (const SphereTree::Level& level : tree.levels) {
        EXPECT_TRUE(certify(*part, level.elements.spheres()).holds);
    }
}

TEST_P(WrittenTree, EveryLevelLiesInside) {
    const RunResult result = run_with("inner");
    EXPECT_TRUE(result.certified);
    const SphereTree tree = read_levels();
    ASSERT_GE(tree.levels.size(), 2u); // balls inside are no tree of parts
    QuietContext context;
    const auto part = Solid::make(registry.make<MeshLoader>("load.mesh")->load(folder.path() / "part.obj", context));
    for (const SphereTree::Level& level : tree.levels) {
        EXPECT_FALSE(level.elements.spheres().empty());
        EXPECT_TRUE(certify_inner(*part, level.elements.spheres()).holds);
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, WrittenTree, testing::ValuesIn(spherizer_names("depth")),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
