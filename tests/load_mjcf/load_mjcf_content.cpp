// The content of a file chooses the loader of robots, and the meshes that load.mjcf makes reach the solids.
#include "loading.hpp"

#include <foam/judge/evaluate.hpp>

namespace foam::test {
namespace {

Original original_of(const std::filesystem::path& file) {
    Registry registry;
    for (const char* plugin : {"/load_mjcf.so", "/load_urdf.so", "/load_mesh.so"}) {
        EXPECT_TRUE(registry.load(std::string(FOAM_TEST_PLUGINS) + plugin).loaded());
    }
    return load_original(file, registry, {});
}

const std::string urdf =
    "<robot name='u'><link name='a'><collision><geometry><sphere radius='1'/></geometry></collision></link></robot>";
const std::string mjcf =
    "<!-- a comment --><mujoco model='m'><worldbody><body name='b'><geom size='1'/></body></worldbody></mujoco>";

TEST(LoadMjcfContent, ChoosesTheLoader) {
    const TemporaryFolder folder;
    for (const char* ending : {"urdf", "xml", "mjcf"}) {
        const std::filesystem::path file = folder.path() / (std::string("robot.") + ending);
        write(file, urdf);
        EXPECT_EQ(original_of(file).links.at(0).link, "a") << ending;
        write(file, mjcf);
        EXPECT_EQ(original_of(file).links.at(0).link, "b") << ending;
    }
}

TEST(LoadMjcfContent, HullsOfMeshesAreTheSolids) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "robot.xml";
    // Two tetrahedra that share a corner; their hull is larger than both.
    write(folder.path() / "two.obj",
          tetrahedron_obj + "v -1 0 0\nv 0 -2 0\nv 0 0 -3\nf 1 5 6\nf 1 7 5\nf 1 6 7\nf 5 7 6\n");
    write(file, "<mujoco><asset><mesh file='two.obj'/></asset><worldbody><geom type='mesh' mesh='two'/>"
                "<body name='c'><geom type='mesh' mesh='two'/></body></worldbody></mujoco>");
    const Original original = original_of(file);
    ASSERT_EQ(original.links.size(), 2u);
    EXPECT_NEAR(original.links[0].solid->volume(), 8, 1e-9); // an octahedron with half axes 1, 2 and 3
    EXPECT_NEAR(original.links[1].solid->volume(), 8, 1e-9);
}

} // namespace
} // namespace foam::test
