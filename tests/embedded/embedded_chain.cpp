// The mesh filters of configs/panda_*.yaml on the embedded robot: flaws go in, closed surfaces of nearly the same solid
// come out.
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

class EmbeddedChain : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        for (const char* plugin : {"/load_mesh.so", "/repair.so", "/simplify_quadric.so", "/smooth.so"}) {
            const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + plugin);
            ASSERT_TRUE(record.loaded()) << record.rejection;
        }
    }

    Registry registry;
    QuietContext context;
};

TEST_P(EmbeddedChain, EndsClosedAndOfNearlyTheSameVolume) {
    const std::filesystem::path folder = FOAM_TEST_SOURCE "/configs/robots/panda/meshes";
    const Mesh raw = registry.make<MeshLoader>("load.mesh")->load(folder / GetParam(), context);
    Mesh mesh = raw;
    const std::map<std::string, ParameterValue> leaves{{"leaves", ParameterValue(std::int64_t{1000})}};
    mesh = registry.make<MeshFilter>("repair.watertight", leaves)->apply(mesh, context);
    EXPECT_TRUE(topology(mesh).closed_manifold()) << "repaired: " << describe(topology(mesh));
    mesh = registry.make<MeshFilter>("simplify.quadric")->apply(mesh, context);
    EXPECT_TRUE(topology(mesh).closed_manifold()) << "simplified: " << describe(topology(mesh));
    mesh = registry.make<MeshFilter>("smooth.humphrey")->apply(mesh, context);
    EXPECT_TRUE(topology(mesh).closed_manifold()) << "smoothed: " << describe(topology(mesh));

    const auto before = Solid::make(raw), after = Solid::make(mesh);
    EXPECT_NEAR(after->volume() / before->volume(), 1.0, 0.1);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(after->bounds().low[axis], before->bounds().low[axis], 0.004) << "axis " << axis;
        EXPECT_NEAR(after->bounds().high[axis], before->bounds().high[axis], 0.004) << "axis " << axis;
    }
}

INSTANTIATE_TEST_SUITE_P(Links, EmbeddedChain,
                         testing::Values("link0.stl", "link1.stl", "link2.obj", "link3.dae", "link4.stl", "link5.obj",
                                         "link6.dae", "link7.stl", "hand.obj", "finger.stl"),
                         [](const auto& test) {
                             const std::string file = test.param;
                             return file.substr(0, file.find('.'));
                         });

} // namespace
} // namespace foam
