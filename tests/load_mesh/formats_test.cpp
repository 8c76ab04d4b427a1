// Small files of each format, written by the test: what is read, and what is refused with which words.
#include "fixture.hpp"
#include "scenes.hpp"

#include <clocale>
#include <cstring>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

std::string little_endian(std::uint32_t value) {
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &value, 4);
    return bytes;
}

std::string binary_stl(std::uint32_t promised, const std::vector<std::array<float, 9>>& triangles) {
    std::string bytes = std::string(80, ' ') + little_endian(promised);
    for (const auto& triangle : triangles) {
        std::string facet(50, '\0');
        std::memcpy(facet.data() + 12, triangle.data(), sizeof triangle);
        bytes += facet;
    }
    return bytes;
}

constexpr std::array<float, 9> one_triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST_F(LoadMesh, FilesThatAreNone) {
    EXPECT_THAT(error_of(folder / "no.stl"), HasSubstr("there is no such file"));
    EXPECT_THAT(error_of(folder), HasSubstr("it is a folder, not a regular file"));
    EXPECT_THAT(error_of("a.step", "x"), HasSubstr("meshes of type '.step' are not read"));
    EXPECT_THAT(error_of("a.stl", ""), HasSubstr("the file is empty"));
}

TEST_F(LoadMesh, Limits) {
    const auto file = write("two.stl", binary_stl(2, {one_triangle, one_triangle}));
    loader = registry.make<MeshLoader>("load.mesh", {{"max_triangles", std::int64_t{1}}});
    EXPECT_THAT(error_of(file), HasSubstr("more than 1 triangles; remedy: "));
    loader = registry.make<MeshLoader>("load.mesh", {{"max_bytes", std::int64_t{100}}});
    EXPECT_THAT(error_of(file), HasSubstr("it has 184 bytes, more than 100; remedy: "));
}

TEST_F(LoadMesh, BinaryStl) {
    EXPECT_EQ(load(write("a.stl", binary_stl(1, {one_triangle}))).triangles.size(), 1u);
    EXPECT_THAT(error_of("b.stl", binary_stl(3, {one_triangle})),
                HasSubstr("promises 3 triangles (234 bytes), but the file has 134 bytes; remedy: "));
    EXPECT_THAT(error_of("c.stl", "short"), HasSubstr("its 5 bytes are fewer than the 84 of a binary header"));
    EXPECT_EQ(load(write("d.stl", binary_stl(1, {one_triangle}) + "tail")).triangles.size(), 1u);
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("4 bytes after the 1 triangles"));
}

TEST_F(LoadMesh, TextStl) {
    const std::string facet =
        "facet normal 0 0 nan outer loop vertex 0 0 0 vertex +1 0 0 vertex 0 1e0 0 endloop endfacet\n";
    EXPECT_EQ(load(write("a.stl", "solid my facet part\n" + facet + "endsolid my facet part\n")).triangles.size(), 1u);
    EXPECT_TRUE(context.messages.empty());
    EXPECT_EQ(load(write("b.stl", "solid\n" + facet)).triangles.size(), 1u);
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("no 'endsolid'"));
    EXPECT_THAT(error_of("c.stl", "solid\nfacet normal 0 0 1 outer loop\nvertex 0 0"),
                HasSubstr("c.stl:3: a coordinate is missing"));
    EXPECT_THAT(error_of("d.stl", "solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 1,5"),
                HasSubstr("d.stl:3: a coordinate is to be a number, got '1,5'"));
    EXPECT_THAT(error_of("e.stl", "solid facet\nfacet normal 0 0 1\n"),
                HasSubstr("the file ends inside a facet, before 'outer'"));
}

TEST_F(LoadMesh, DegenerateTrianglesAreKeptAndSaid) {
    const Mesh mesh = load(write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 2 4\nf 2 5 4\n"));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.vertices.size(), 4u) << "equal vertices are one";
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("2 of 3 triangles have no area"));
    EXPECT_EQ(context.metrics["triangles"], 3);
    EXPECT_EQ(context.metrics["vertices"], 4);
}

TEST_F(LoadMesh, ObjKeepsDoublePrecision) {
    const Mesh mesh = load(write("a.obj", "v 10000.000000001 0 0\nv 1 -0 0\nv 0 1e-320 1e-400\nf 1 2 3\n"));
    EXPECT_EQ(mesh.vertices[0].x, 10000.000000001);
    EXPECT_EQ(mesh.vertices[2].z, 0);
    EXPECT_THAT(error_of("b.obj", "v 1e400 0 0\n"),
                HasSubstr("b.obj:1: a coordinate of the vertex is to be a number, got '1e400'"));
}

TEST_F(LoadMesh, ObjDetails) {
    const std::string points = "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n";
    EXPECT_EQ(load(write("a.obj", points + "f 1 2 \\\r\n3 4 # a quad\r\n")).triangles.size(), 2u);
    EXPECT_EQ(load(write("b.obj", "f 1 2 3\n" + points)).triangles.size(), 1u) << "vertices after the face";
    EXPECT_EQ(load(write("c.obj", points + "f 1 2 3\nf 1 2\n")).triangles.size(), 1u);
    EXPECT_THAT(context.messages.back(), HasSubstr("1 faces of fewer than three corners"));
    EXPECT_THAT(error_of("d.obj", points + "f 1 2 -9\n"), HasSubstr("d.obj:5: the face counts back to"));
    EXPECT_THAT(error_of("e.obj", points + "f 1 2 x\n"),
                HasSubstr("e.obj:5: a face's corner is to be a vertex index, got 'x'"));
    EXPECT_THAT(error_of("f.obj", points), HasSubstr("there are no triangles in it, only 4 points"));
}

/// A C, which a fan from its first corner would fill.
TEST_F(LoadMesh, ConcavePolygonsAreCutAlongTheInside) {
    const std::string c = "v 3 3 0\nv 0 3 0\nv 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 2 0\nv 3 2 0\n";
    const Mesh mesh = load(write("c.obj", c + "f 1 2 3 4 5 6 7 8\n"));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_NEAR(surface_area(mesh), 7, 1e-12) << "the sum of the areas is the polygon's only if they do not overlap";
    for (const auto& [i, j, k] : mesh.triangles) {
        EXPECT_GE(cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]).z, 0);
    }
}

TEST_F(LoadMesh, HugeAndTangledPolygonsEnd) {
    std::string text, face = "f";
    for (int i = 0; i < 20000; ++i) { // a comb: every second corner is concave
        text.append("v ").append(std::to_string(i - i % 2)).append(i % 2 == 0 ? " 0 0\n" : " 1 0\n");
        face.append(" ").append(std::to_string(i + 1));
    }
    const auto file = write("comb.obj", text + face + "\n");
    try {
        EXPECT_EQ(load(file).triangles.size(), 19998u);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("too tangled"));
    }
    EXPECT_EQ(load(write("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n")).triangles.size(), 2u);
}

TEST_F(LoadMesh, Off) {
    const std::string body = "3 1 0\n0 0 0\n1 0 0\n0 1 0 # corner\n3 0 1 2 255 0 0\n";
    EXPECT_EQ(load(write("a.off", "OFF\n# comment\n\n" + body)).triangles.size(), 1u);
    EXPECT_EQ(load(write("b.off", "COFF " + body)).triangles.size(), 1u);
    EXPECT_EQ(load(write("c.off", body)).triangles.size(), 1u);
    EXPECT_THAT(error_of("d.off", "OFF\n4000000000 1 0\n0 0 0\n"),
                HasSubstr("d.off:2: the file promises 4000000000 vertices, but only 6 bytes follow"));
    EXPECT_THAT(error_of("e.off", "OFF\n1 1 0\n0 0 0\n3 0 1 2\n"),
                HasSubstr("e.off:4: the face refers to vertex 1, but the file has 1"));
    EXPECT_THAT(error_of("f.off", "OFF BINARY\n"), HasSubstr("binary OFF is not read"));
    EXPECT_THAT(error_of("g.off", "4OFF\n1 0 0\n"), HasSubstr("4OFF files are not read"));
    EXPECT_THAT(error_of("h.off", "OFF\n2 0 0\n0 0 0\n"), HasSubstr("the file ends before vertex 2 of 2"));
}

std::string ply_header(const std::string& format, const std::string& count) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + count +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\nproperty list uchar int "
           "vertex_indices\n"
           "end_header\n";
}

TEST_F(LoadMesh, Ply) {
    const std::string body = "0 0 0\n10000.000000001 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(load(write("a.ply", ply_header("ascii", "3") + body)).vertices[1].x, 10000.000000001);
    EXPECT_THAT(error_of("b.ply", ply_header("ascii", "4000000000") + body),
                HasSubstr("promises 4000000000 elements 'vertex' of at least 6 bytes, but only "));
    EXPECT_THAT(error_of("c.ply", ply_header("binary_little_endian", "3") + std::string(75, '\1')),
                HasSubstr("bytes, inside face 0; remedy: export or copy it again"));
    EXPECT_THAT(error_of("d.ply", ply_header("ascii", "3") + "0 0 0\n0 nan 0\n0 1 0\n3 0 1 2\n"),
                HasSubstr("d.ply:11: vertex 1 (counted from 0): the vertex is not finite: (0, nan, 0)"));
    EXPECT_THAT(error_of("e.ply", ply_header("ascii", "3") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
                HasSubstr("it refers to vertex 7, but 3"));
    EXPECT_THAT(error_of("f.ply", "ply\nformat ascii 1.0\nelement"), HasSubstr("the file ends inside the PLY header"));
    EXPECT_THAT(error_of("g.ply", "plx\n"), HasSubstr("it is no PLY"));
}

TEST_F(LoadMesh, PlyTriangleStrips) {
    const Mesh mesh = load(
        write("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n"));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {0, 1, 3}}));
}

TEST_F(LoadMesh, UnusedVerticesMayBeAnything) {
    EXPECT_EQ(load(write("a.obj", "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n")).triangles.size(), 1u);
    EXPECT_THAT(error_of("b.obj", "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 4\n"),
                HasSubstr("b.obj:1: a coordinate of the vertex is not finite: (nan, 0, 0); remedy: "));
    const std::string off = "OFF\n4 1 0\ninf 0 0\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(load(write("c.off", off + "3 1 2 3\n")).triangles.size(), 1u);
    EXPECT_THAT(error_of("d.off", off + "3 0 2 3\n"),
                HasSubstr("d.off:3: the vertex is not finite: (inf, 0, 0); remedy: "));
    const std::string ply = ply_header("ascii", "4") + "0 -inf 0\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(load(write("e.ply", ply + "3 1 2 3\n")).triangles.size(), 1u);
    EXPECT_THAT(error_of("f.ply", ply + "3 0 2 3\n"),
                HasSubstr("f.ply:10: vertex 0 (counted from 0): the vertex is not finite: (0, -inf, 0); remedy: "));
}

TEST_F(LoadMesh, OtherLocalesChangeNothing) {
    const char* german = nullptr;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"}) {
        german = german ? german : std::setlocale(LC_ALL, name);
    }
    if (!german) {
        GTEST_SKIP() << "no locale with a decimal comma is installed";
    }
    const double obj = load(write("a.obj", "v 0 0 0\nv 1.5 0 0\nv 0 1 0\nf 1 2 3\n")).vertices[1].x;
    const double dae = load(write("a.dae", collada("<unit meter=\"0.01\"/>", "0 1 2", identity))).vertices[1].x;
    const double gltf_x = load(write("a.gltf", gltf(R"([{"mesh":0,"translation":[0.5,0,0]}])", "3"))).vertices[1].x;
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(obj, 1.5);
    EXPECT_NEAR(dae, 1, 1e-12);
    EXPECT_EQ(gltf_x, 1.5);
}

} // namespace
} // namespace foam::test
