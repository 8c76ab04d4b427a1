// Small files of each format, written by the test: what is read, and what is refused with which words.
#include "fixture.hpp"

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

TEST_F(LoadAssimp, FilesThatAreNone) {
    EXPECT_THAT(error_of(folder / "no.stl"), HasSubstr("there is no such file"));
    EXPECT_THAT(error_of(folder), HasSubstr("it is not a regular file"));
    EXPECT_THAT(error_of("a.step", "x"), HasSubstr("meshes of type '.step' are not read"));
    EXPECT_THAT(error_of("a.stl", ""), HasSubstr("the file is empty"));
}

TEST_F(LoadAssimp, Limits) {
    const auto file = write("two.stl", binary_stl(2, {one_triangle, one_triangle}));
    loader = registry.make<MeshLoader>("load.assimp", {{"max_triangles", std::int64_t{1}}});
    EXPECT_THAT(error_of(file), HasSubstr("more than 1 triangles; remedy: "));
    loader = registry.make<MeshLoader>("load.assimp", {{"max_bytes", std::int64_t{100}}});
    EXPECT_THAT(error_of(file), HasSubstr("it has 184 bytes, more than 100; remedy: "));
}

TEST_F(LoadAssimp, BinaryStl) {
    EXPECT_EQ(load(write("a.stl", binary_stl(1, {one_triangle}))).triangles.size(), 1u);
    EXPECT_THAT(error_of("b.stl", binary_stl(3, {one_triangle})),
                HasSubstr("promises 3 triangles (234 bytes), but the file has 134 bytes; remedy: "));
    EXPECT_THAT(error_of("c.stl", "short"), HasSubstr("its 5 bytes are fewer than the 84 of a binary header"));
    EXPECT_EQ(load(write("d.stl", binary_stl(1, {one_triangle}) + "tail")).triangles.size(), 1u);
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("4 bytes after the 1 triangles"));
}

TEST_F(LoadAssimp, TextStl) {
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

TEST_F(LoadAssimp, DegenerateTrianglesAreKeptAndSaid) {
    const Mesh mesh = load(write("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 2 4\nf 2 5 4\n"));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.vertices.size(), 4u) << "equal vertices are one";
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("2 of 3 triangles have no area"));
    EXPECT_EQ(context.metrics["triangles"], 3);
    EXPECT_EQ(context.metrics["vertices"], 4);
}

TEST_F(LoadAssimp, ObjKeepsDoublePrecision) {
    const Mesh mesh = load(write("a.obj", "v 10000.000000001 0 0\nv 1 -0 0\nv 0 1e-320 1e-400\nf 1 2 3\n"));
    EXPECT_EQ(mesh.vertices[0].x, 10000.000000001);
    EXPECT_EQ(mesh.vertices[2].z, 0);
    EXPECT_THAT(error_of("b.obj", "v 1e400 0 0\n"),
                HasSubstr("b.obj:1: a coordinate of the vertex is to be a number, got '1e400'"));
}

TEST_F(LoadAssimp, ObjDetails) {
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
TEST_F(LoadAssimp, ConcavePolygonsAreCutAlongTheInside) {
    const std::string c = "v 3 3 0\nv 0 3 0\nv 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 2 0\nv 3 2 0\n";
    const Mesh mesh = load(write("c.obj", c + "f 1 2 3 4 5 6 7 8\n"));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_NEAR(surface_area(mesh), 7, 1e-12) << "the sum of the areas is the polygon's only if they do not overlap";
    for (const auto& [i, j, k] : mesh.triangles) {
        EXPECT_GE(cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]).z, 0);
    }
}

TEST_F(LoadAssimp, HugeAndTangledPolygonsEnd) {
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

TEST_F(LoadAssimp, Off) {
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

TEST_F(LoadAssimp, Ply) {
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

TEST_F(LoadAssimp, PlyTriangleStrips) {
    const Mesh mesh = load(
        write("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n"));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {0, 1, 3}}));
}

std::string collada(const std::string& unit, const std::string& indices, const std::string& matrix) {
    return "<COLLADA version=\"1.4.1\"><asset>" + unit +
           "<up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"s\"><float_array "
           "id=\"a\" "
           "count=\"9\">0 0 0 100 0 0 0 100 0</float_array><technique_common><accessor source=\"#a\" count=\"3\" "
           "stride=\"3\">"
           "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
           "type=\"float\"/></accessor>"
           "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
           "source=\"#s\"/></vertices><triangles "
           "count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" +
           indices +
           "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene "
           "id=\"sc\"><node><matrix>" +
           matrix +
           "</matrix><instance_geometry "
           "url=\"#g\"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#sc\"/></scene></COLLADA>";
}

constexpr const char* identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

TEST_F(LoadAssimp, ColladaAppliesTheUnitAndNotTheUpAxis) {
    const Mesh mesh = load(write("a.dae", collada("<unit meter=\"0.01\"/>", "0 1 2", identity)));
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_NEAR(mesh.vertices[1].x, 1, 1e-6);
    EXPECT_NEAR(mesh.vertices[2].y, 1, 1e-6);
    EXPECT_NEAR(load(write("b.dae", collada("", "0 1 2", identity))).vertices[1].x, 100, 1e-6) << "no unit: metres";
}

TEST_F(LoadAssimp, ColladaMirroredNodesKeepTheOutside) {
    const Mesh mesh = load(write("a.dae", collada("", "0 1 2", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")));
    const auto& [a, b, c] = mesh.triangles.at(0);
    EXPECT_GT(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z, 0);
}

TEST_F(LoadAssimp, ColladaThatWouldHangOrCrashAssimpIsRefused) {
    EXPECT_THAT(error_of("a.dae", collada("", "0 nan 2", identity)),
                HasSubstr("a.dae:1: <p> holds 'nan', which is no index"));
    EXPECT_THAT(error_of("b.dae", collada("", "0 1 2", "1 0 0")), HasSubstr("<matrix> holds 3 numbers, 16 are needed"));
    std::string text = collada("", "0 1 2", identity);
    text.replace(text.find("count=\"9\""), 9, "c0unt=\"9\"");
    EXPECT_THAT(error_of("c.dae", text), HasSubstr("the float_array has no count"));
    text = collada("", "0 1 2", identity);
    text.replace(text.find("count=\"3\""), 9, "count=\"9\"");
    EXPECT_THAT(error_of("d.dae", text), HasSubstr("the accessor needs 27 values, but 'a' has 9"));
    text = collada("", "0 1 2", identity);
    text.replace(text.find("count=\"9\""), 9, "count=\"4000000000\"");
    EXPECT_THAT(error_of("e.dae", text), HasSubstr("count='4000000000' cannot be true of a file of "));
    EXPECT_THAT(error_of("f.dae", "<html/>"), HasSubstr("it holds no COLLADA"));
}

/// One triangle in a base64 buffer of 36 bytes.
std::string gltf(const std::string& nodes, const std::string& count) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":)"
           R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
           count + "}]}";
}

TEST_F(LoadAssimp, Gltf) {
    const Mesh mesh = load(write("a.gltf", gltf(R"([{"mesh":0,"translation":[0,0,2]}])", "3")));
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 2}));
    EXPECT_THAT(error_of("b.gltf", gltf(R"([{"mesh":0}])", "4")),
                HasSubstr("accessors[0] needs 48 bytes of bufferViews[0], which has 36"));
    EXPECT_THAT(error_of("c.gltf", gltf(R"([{"mesh":0}])", "4000000000")),
                HasSubstr("accessors[0] has 4000000000 elements"));
    EXPECT_THAT(error_of("d.gltf", gltf(R"([{"mesh":0,"children":[0]}])", "3")),
                HasSubstr("nodes[0] is its own ancestor"));
    EXPECT_THAT(error_of("e.gltf", gltf(R"([{"mesh":7}])", "3")),
                HasSubstr("nodes[0].mesh refers to meshes[7], but there are 1"));
    EXPECT_THAT(error_of("f.gltf", "not json"), HasSubstr("its text is no JSON object"));
    EXPECT_THAT(error_of("g.gltf", std::string(100000, '[')), HasSubstr("nested more than 200 deep"));
    EXPECT_THAT(error_of("h.glb", std::string("glTF\1\0\0\0", 8) + "xxxx"),
                HasSubstr("it is glTF 1; remedy: export glTF 2.0"));
}

TEST_F(LoadAssimp, OtherLocalesChangeNothing) {
    const char* german = nullptr;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"}) {
        german = german ? german : std::setlocale(LC_ALL, name);
    }
    if (!german) {
        GTEST_SKIP() << "no locale with a decimal comma is installed";
    }
    const double x = load(write("a.dae", collada("<unit meter=\"0.01\"/>", "0 1 2", identity))).vertices[1].x;
    const double y = load(write("a.obj", "v 0 0 0\nv 1.5 0 0\nv 0 1 0\nf 1 2 3\n")).vertices[1].x;
    std::setlocale(LC_ALL, "C");
    EXPECT_NEAR(x, 1, 1e-6);
    EXPECT_EQ(y, 1.5);
}

} // namespace
} // namespace foam::test
