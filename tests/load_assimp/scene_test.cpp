// What is taken from a scene, and what is refused.
#include "fixture.hpp"

#include <limits>
#include <sys/stat.h>

namespace foam::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Format assbin{"assbin", "assbin"}; // keeps whatever it is given

aiMatrix4x4 moved(float x, float y, float z) {
    return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1};
}

std::vector<std::unique_ptr<aiMesh>> one(std::unique_ptr<aiMesh> part) {
    std::vector<std::unique_ptr<aiMesh>> parts;
    parts.push_back(std::move(part));
    return parts;
}

class Scenes : public LoadAssimp {
protected:
    std::string refusal(std::unique_ptr<aiScene> scene, const std::map<std::string, ParameterValue>& parameters = {}) {
        return error_of(exported(*scene, assbin), parameters);
    }
};

TEST_F(Scenes, NodesPlaceTheirMeshes) {
    aiNode* const outer = node_of({0}, moved(10, 0, 0));
    const aiMatrix4x4 mirror{-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 5, 0, 0, 0, 1};
    aiNode* inner = node_of({0}, mirror);
    outer->addChildren(1, &inner);
    const Mesh got = load(exported(*scene_of(one(part_of(sample::bracket())), {outer}), assbin));

    Mesh wanted = transformed(sample::bracket(), Pose::from_xyz_rpy({10, 0, 0}, {}));
    append(wanted, transformed(sample::bracket(), Pose::from_xyz_rpy({10, 0, 5}, {}), {-2, 2, 2}));
    expect_same(got, wanted);
    EXPECT_GT(signed_volume(got), 0) << "the mirrored one is inside out";
    EXPECT_EQ(topology(got).misoriented_edges, 0u);
}

TEST_F(Scenes, LinesAndPointsAreLeftOutAndCounted) {
    auto part = part_of(sample::bracket());
    part->mFaces[3].mNumIndices = 2;
    part->mFaces[5].mNumIndices = 1;
    part->mPrimitiveTypes |= aiPrimitiveType_LINE | aiPrimitiveType_POINT;
    const Mesh got = load(exported(*scene_of(one(std::move(part)), {node_of({0})}), assbin));
    EXPECT_EQ(got.triangles.size(), sample::bracket().triangles.size() - 2);
    EXPECT_THAT(notes.messages, ElementsAre("2 lines and points are left out"));
}

TEST_F(Scenes, OnlyLinesAreAnError) {
    auto part = part_of(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    part->mFaces[0].mNumIndices = 2;
    part->mPrimitiveTypes = aiPrimitiveType_LINE;
    EXPECT_EQ(refusal(scene_of(one(std::move(part)), {node_of({0})})),
              "there are no triangles in it, only lines and points; remedy: export a surface");
}

TEST_F(Scenes, ASceneThatShowsNothingIsAnError) {
    EXPECT_EQ(refusal(scene_of(one(part_of(sample::bracket())), {node_of({})})),
              "there are no triangles in it; remedy: export a surface");
}

TEST_F(Scenes, PolygonsAreCutIntoTriangles) {
    const auto file = write("quad.x", "xof 0303txt 0032\nMesh square {\n4;\n0;0;0;,\n1;0;0;,\n1;1;0;,\n0;1;0;;\n"
                                      "1;\n4;0,1,2,3;;\n}\n");
    const Mesh got = load(file);
    EXPECT_EQ(got.triangles.size(), 2u);
    EXPECT_NEAR(surface_area(got), 1, 1e-6);
}

TEST_F(Scenes, VerticesThatAreNotFiniteAreAnErrorWhereAFaceUsesThem) {
    Mesh mesh = sample::bracket();
    mesh.vertices.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
    expect_same(load(exported(*scene_of(mesh), assbin)), sample::bracket());
    mesh.triangles[0][1] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    EXPECT_EQ(refusal(scene_of(mesh)),
              "a vertex is not finite: (nan, nan, nan); remedy: export the mesh again without it");
    aiMatrix4x4 infinite;
    infinite.b4 = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(scene_of(one(part_of(sample::bracket())), {node_of({0}, infinite)})),
                HasSubstr("a vertex is not finite: ("));
}

TEST_F(Scenes, FacesBeyondTheVerticesAreAnError) {
    auto part = part_of(sample::bracket());
    part->mFaces[7].mIndices[2] = 4711;
    EXPECT_EQ(refusal(scene_of(one(std::move(part)), {node_of({0})})),
              "a face refers to vertex 4711 of 12; remedy: the file is damaged, export it again");
}

TEST_F(Scenes, NodesBeyondTheMeshesAreAnError) {
    EXPECT_EQ(refusal(scene_of(one(part_of(sample::bracket())), {node_of({0, 3})})),
              "a node refers to mesh 3 of 1; remedy: the file is damaged, export it again");
}

TEST_F(Scenes, NestingHasAnEnd) {
    const auto nested = [](int depth) {
        aiNode* node = node_of({0});
        for (int i = 0; i < depth; ++i) {
            aiNode* above = node_of({}, moved(1, 0, 0));
            above->addChildren(1, &node);
            node = above;
        }
        return scene_of(one(part_of(sample::bracket())), {node});
    };
    EXPECT_NEAR(bounds(load(exported(*nested(900), assbin))).low.x, 900, 1e-3);
    EXPECT_EQ(refusal(nested(1100)), "nodes lie more than 1000 deep in nodes; remedy: flatten the scene");
}

TEST_F(Scenes, NumbersOfTrianglesAreLimited) {
    const std::map<std::string, ParameterValue> most{{"max_triangles", std::int64_t{30}}};
    const std::string message =
        "more than 30 triangles; remedy: simplify the mesh, or raise max_triangles of load.assimp";
    EXPECT_EQ(error_of(exported(*scene_of(sample::bracket()), assbin), most), "") << "20 triangles";
    EXPECT_EQ(refusal(scene_of(sample::torus(1, 0.2)), most), message);
    EXPECT_EQ(refusal(scene_of(one(part_of(sample::bracket())), {node_of({0}), node_of({0})}), most), message)
        << "each instance counts";
}

TEST_F(LoadAssimp, FilesAreReadAsOursAre) {
    const auto file = exported(*scene_of(sample::bracket()), {"3ds", "3ds"});
    EXPECT_THAT(error_of(file, {{"max_bytes", std::int64_t{100}}}),
                HasSubstr("; remedy: simplify the mesh, or raise max_bytes of load.assimp"));
    EXPECT_EQ(error_of(write("empty.3ds", "")), "the file is empty; remedy: export it again");
    EXPECT_EQ(error_of(folder.path() / "missing.3ds"), "there is no such file; remedy: check the path");
    const auto pipe = folder.path() / "pipe.3ds";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(error_of(pipe), HasSubstr("remedy: "));
}

TEST_F(LoadAssimp, NamesOfFilesMayBeAnything) {
    std::ifstream stream(exported(*scene_of(sample::bracket()), {"3ds", "3ds"}), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    for (const char* name : {"PART.3DS", "with space.3ds", "back\\slash.3ds", "größe.v1.2.3ds", "-n.3ds"}) {
        SCOPED_TRACE(name);
        expect_same(load(write(name, bytes)), sample::bracket());
    }
    std::filesystem::create_directory(folder.path() / "deeper");
    write("deeper/part.3ds", bytes);
    std::filesystem::current_path(folder.path()); // each test is a process of its own
    expect_same(load("deeper/../deeper/part.3ds"), sample::bracket());
    std::filesystem::current_path("/");
}

TEST_F(LoadAssimp, OtherFilesAreReadFromTheFolderOfTheMeshAlone) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::filesystem::create_directory(folder.path() / "within");
    write("outside.mtl", "newmtl a\n");
    write("within/beside.mtl", "newmtl a\n");
    load(write("within/a.obj", "mtllib beside.mtl\n" + triangle));
    EXPECT_THAT(notes.messages, ElementsAre());
    load(write("within/b.obj", "mtllib ../outside.mtl\n" + triangle));
    EXPECT_THAT(notes.messages, Contains(HasSubstr("outside.mtl: it lies outside of the folder of the mesh")));
}

TEST_F(LoadAssimp, WhatIsNoMeshIsRefusedWithTheReason) {
    EXPECT_THAT(
        error_of(write("noise.3ds", std::string(3000, 'x'))),
        ::testing::AllOf(::testing::StartsWith("assimp cannot read it: "),
                         ::testing::EndsWith("; remedy: export it again, or as STL, OBJ, PLY, DAE, OFF or GLB")));
}

} // namespace
} // namespace foam::test
