// What assimp's exporters write is read as it was: axes, units, every triangle.
#include "fixture.hpp"
#include "support/shared_folder.hpp"

#include <clocale>
#include <cstdlib>

namespace foam::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// The locale as it was, in the end.
class LocaleGuard {
public:
    ~LocaleGuard() { std::setlocale(LC_ALL, before_.c_str()); }

private:
    std::string before_ = std::setlocale(LC_ALL, nullptr);
};

bool set_decimal_comma(const std::filesystem::path& folder) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "it_IT.UTF-8", "es_ES.UTF-8"}) {
        if (std::setlocale(LC_ALL, name)) {
            return true;
        }
    }
    const std::string made = (folder / "de_DE.UTF-8").string();
    if (std::system(("localedef -f UTF-8 -i de_DE '" + made + "' >/dev/null 2>&1").c_str()) != 0) {
        return false;
    }
    setenv("LOCPATH", folder.c_str(), 1); // each test is a process of its own
    return std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
}

class Exported : public LoadAssimp, public ::testing::WithParamInterface<Format> {};

std::string name_of(const ::testing::TestParamInfo<Format>& info) {
    return std::string("As_") + info.param.id;
}

TEST_P(Exported, IsReadAsItWas) {
    const Mesh bracket = sample::bracket(); // no two of its sizes are the same, none is centred
    const Mesh got = load(exported(*scene_of(bracket), GetParam()));
    const double metres = GetParam().metres;
    expect_same(got, transformed(bracket, {}, {metres, metres, metres}));
    EXPECT_EQ(got.vertices.size(), bracket.vertices.size());
}

TEST_P(Exported, OfTheCorpusIsReadAsItWas) {
    const auto meshes = shared_folder() / "meshes";
    if (!std::filesystem::exists(meshes)) {
        GTEST_SKIP() << "no folder " << meshes;
    }
    const auto ours = registry.make<MeshLoader>("load.mesh");
    const double metres = GetParam().metres;
    for (const char* name : {"real/suzanne.obj", "real/featuretype.STL", "real/multibody.stl", "real/bunny_7k.off",
                             "synthetic/mm_y_up_instances.dae"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = welded(ours->load(meshes / name, notes));
        expect_same(load(exported(*scene_of(mesh), GetParam())), transformed(mesh, {}, {metres, metres, metres}));
    }
}

INSTANTIATE_TEST_SUITE_P(Format, Exported, ::testing::ValuesIn(formats), name_of);

// All formats in one test: to make a locale takes longer than to read them all.
TEST_F(LoadAssimp, ReadsEveryFormatInTheLocaleOfAnyUser) {
    std::vector<std::filesystem::path> files;
    std::vector<Mesh> wanted;
    for (const Format& format : formats) {
        files.push_back(exported(*scene_of(sample::bracket()), format, format.id));
        wanted.push_back(load(files.back()));
    }
    const LocaleGuard guard;
    if (!set_decimal_comma(folder.path())) {
        GTEST_SKIP() << "no locale with a decimal comma";
    }
    ASSERT_STREQ(std::localeconv()->decimal_point, ",");
    for (std::size_t i = 0; i < files.size(); ++i) {
        EXPECT_EQ(load(files[i]), wanted[i]) << formats[i].id;
        EXPECT_STREQ(std::localeconv()->decimal_point, ",") << "the user's locale is not as it was: " << formats[i].id;
    }
}

/// Instances, units and the up-axis: both readers must see the same.
TEST_F(LoadAssimp, AgreesWithOurReadersOnScenes) {
    const auto meshes = shared_folder() / "meshes/synthetic";
    if (!std::filesystem::exists(meshes)) {
        GTEST_SKIP() << "no folder " << meshes;
    }
    const auto ours = registry.make<MeshLoader>("load.mesh");
    for (const char* name : {"mm_y_up_instances.dae", "inch_x_up.dae", "node_scale.glb", "embedded.gltf",
                             "negative_indices.obj", "star_ngon_concave.obj", "ascii_multi_solid.stl"}) {
        SCOPED_TRACE(name);
        expect_same(load(meshes / name), welded(ours->load(meshes / name, notes)), 2e-5);
    }
}

TEST_F(LoadAssimp, ReadsFormatsThatAreWrittenByHand) {
    const Mesh tetrahedron{{{0, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    for (const char* ending : {"ac", "amf", "ase"}) {
        SCOPED_TRACE(ending);
        const std::filesystem::path samples = FOAM_TEST_SOURCE "/plugins/load_assimp/samples";
        const Vec3 at{ending == std::string("ac") ? 10.0 : 0.0, 0, 0}; // its node is moved
        Mesh wanted = tetrahedron;
        for (Vec3& vertex : wanted.vertices) {
            vertex += at;
        }
        expect_same(load(samples / (std::string("tetrahedron.") + ending)), wanted);
    }
}

TEST_F(LoadAssimp, DxfKeepsItsAxes) {
    std::string text = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n";
    const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 3}, {0, 2, 3}};
    for (int corner = 0; corner < 4; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            text += std::to_string(10 * (axis + 1) + corner) + "\n" + std::to_string(corners[corner][axis]) + "\n";
        }
    }
    const Mesh got = load(write("face.dxf", text + "0\nENDSEC\n0\nEOF\n"));
    EXPECT_EQ(bounds(got).low, Vec3{});
    EXPECT_EQ(bounds(got).high, (Vec3{1, 2, 3}));
    EXPECT_EQ(got.triangles.size(), 1u);
}

TEST_F(LoadAssimp, IfcIsInMetresWithTheAxesOfTheFile) {
    expect_same(load(FOAM_TEST_SOURCE "/tests/load_assimp/millimetres.ifc"), sample::box({1, 2, 3}, {0.5, 1, 1.5}));
}

TEST_F(LoadAssimp, FbxHasItsUnitScaleFactor) {
    const auto file = exported(*scene_of(sample::bracket()), {"fbxa", "fbx"});
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    std::string bytes = text.str();
    const std::string written = "\"UnitScaleFactor\", \"double\", \"Number\", \"\", 1";
    const std::size_t at = bytes.find(written);
    ASSERT_NE(at, bytes.npos) << bytes.substr(0, 3000);
    bytes.replace(at + written.size() - 1, 1, "2.54");
    expect_same(load(write("inch.fbx", bytes)), transformed(sample::bracket(), {}, {0.0254, 0.0254, 0.0254}));
}

TEST_F(LoadAssimp, SaysThatTheUnitOf3mfIsNotRead) {
    load(exported(*scene_of(sample::bracket()), {"3mf", "3mf"}));
    EXPECT_THAT(notes.messages, Contains(HasSubstr("the unit that the file states is not read")));
}

} // namespace
} // namespace foam::test
