// Plugins of another compiler make the same bytes; those of careless compiler options are found.
#include "fixture.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>

#include <cfenv>
#include <limits>
#include <vector>

namespace foam::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class Compiler : public Reproduce {
protected:
    /// Builds plugins of ours with clang++ as anybody's plugins are built; returns their files.
    std::vector<std::string> built_by_clang(const std::vector<std::string>& plugins) const {
        std::string project = "cmake_minimum_required(VERSION 3.25)\n"
                              "project(theirs LANGUAGES CXX)\n"
                              "find_package(foam REQUIRED)\n";
        std::vector<std::string> files;
        for (const std::string& plugin : plugins) {
            project += "add_subdirectory(\"" FOAM_TEST_SOURCE "/plugins/" + plugin + "\" " + plugin + ")\n";
            files.push_back("build/" + plugin + "/" + plugin + ".so");
        }
        write("CMakeLists.txt", project);
        const Outcome outcome = shell("unset CXXFLAGS LDFLAGS && '" FOAM_TEST_CMAKE "' -S . -B build "
                                      "-G '" FOAM_TEST_GENERATOR "' -DCMAKE_BUILD_TYPE=Release "
                                      "-DCMAKE_CXX_COMPILER='" FOAM_TEST_CLANG "' -Dfoam_DIR='" FOAM_TEST_PACKAGE
                                      "' && '" FOAM_TEST_CMAKE "' --build build");
        EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
        for (const std::string& file : files) {
            EXPECT_THAT(contents(path() / file), HasSubstr("clang version")) << file << " is not the work of clang";
        }
        return files;
    }
};

/// Every number as it is, bit by bit.
std::string hexadecimal(const SphereTree& tree) {
    std::string text;
    for (const SphereTree::Level& level : tree.levels) {
        for (const Sphere& s : level.elements.spheres()) {
            char line[128];
            std::snprintf(line, sizeof line, "%a %a %a %a\n", s.center.x, s.center.y, s.center.z, s.radius);
            text += line;
        }
    }
    return text;
}

std::string hexadecimal(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) {
        char line[128];
        std::snprintf(line, sizeof line, "%a %a %a\n", v.x, v.y, v.z);
        text += line;
    }
    return text;
}

/// What the stages of a registry make of the bumpy mesh.
std::string made_by(const Registry& registry, const std::filesystem::path& file) {
    QuietContext context;
    const Mesh mesh = registry.make<MeshLoader>("load.mesh")->load(file, context);
    const Mesh smooth = registry.make<MeshFilter>("smooth.humphrey")->apply(mesh, context);
    const auto solid = Solid::make({{.mesh = std::make_shared<const Mesh>(smooth), .primitive = {}, .pose = {}}});
    const Shape shape("bumpy", solid, solid);
    std::string text = hexadecimal(smooth);
    for (const char* stage : {"spherize.grid", "spherize.octree"}) {
        for (const std::size_t count : {1u, 7u, 20u}) {
            Budget budget;
            budget.max_spheres = count;
            text += stage;
            text += "\n" + hexadecimal(registry.make<Spherizer>(stage)->spherize(shape, budget, context));
        }
    }
    return text;
}

TEST_F(Compiler, PluginsOfClangMakeTheSameBytes) {
    if (std::string(FOAM_TEST_CLANG).empty()) {
        GTEST_SKIP() << "there is no clang++, or foam is built with sanitizers";
    }
    const std::vector<std::string> files = built_by_clang({"spherize_grid", "spherize_octree", "smooth"});
    Registry ours, theirs;
    std::string options;
    for (const std::string& file : files) {
        EXPECT_EQ(theirs.load(path() / file).rejection, "");
        options += "--plugin " + file + " ";
    }
    ours.load_directory(FOAM_TEST_PLUGINS);
    theirs.load_directory(FOAM_TEST_PLUGINS);
    EXPECT_EQ(made_by(ours, path() / "bumpy.obj"), made_by(theirs, path() / "bumpy.obj"));

    must("run two.yaml --fresh --run-dir out");
    const Outcome outcome = foam(options + "verify out --json");
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_THAT(outcome.out, ContainsRegex("plugin smooth [0-9.]+: another build of it"))
        << "it was not the plugin of clang";
}

TEST_F(Compiler, FastMathIsFound) {
    write("sum.yaml", "foam: 1\nname: sum\nrobot: {urdf: two.urdf}\nstages: [spherize.summing]\n");
    must("--plugin '" FOAM_TEST_STRICT "' run sum.yaml --fresh --run-dir out");
    EXPECT_EQ(foam("--plugin '" FOAM_TEST_STRICT "' verify out").code, 0);
    const Outcome outcome = foam("--plugin '" FOAM_TEST_FAST "' verify out");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out,
                HasSubstr("first difference: link 'base', stage 'spherize.summing', 'bumpy.obj'\n  expected "));
    EXPECT_THAT(outcome.out, HasSubstr("likely reasons:\n  plugin spherize_summing 1.0: another build of it "));
}

/// g++ links code into -ffast-math libraries that, when they are loaded, has the processor flush small numbers to 0.
TEST_F(Compiler, LoadingAPluginLeavesTheArithmeticAlone) {
    const volatile double smallest = std::numeric_limits<double>::min();
    Registry registry;
    EXPECT_EQ(registry.load(FOAM_TEST_FAST).rejection, "");
    EXPECT_GT(smallest / 2, 0);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

} // namespace
} // namespace foam::test
