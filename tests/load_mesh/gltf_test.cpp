// glTF files written by the test: what is read, and what is refused with which words.
#include "fixture.hpp"
#include "scenes.hpp"

#include <cstring>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

template <class T> std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string chunk(const std::string& type, std::string bytes, char padding) {
    bytes.resize((bytes.size() + 3) / 4 * 4, padding);
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(bytes.size())}) + type + bytes;
}

std::string glb(const std::string& json, const std::string& binary) {
    const std::string chunks = chunk("JSON", json, ' ') + chunk(std::string("BIN\0", 4), binary, '\0');
    return "glTF" + bytes_of<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

/// The square (0,0) (1,0) (0,1) (1,1), four floats a point, then 16-bit indices at byte 64, then whatever; one mesh
/// with `primitive`, buffer views 0 (points) and 1 (the rest).
std::string square(const std::string& primitive, const std::string& accessors, const std::string& more = "",
                   std::string binary = "") {
    binary = bytes_of<float>({0, 0, 0, 7, 1, 0, 0, 7, 0, 1, 0, 7, 1, 1, 0, 7}) + binary;
    return glb(
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitive +
            R"(]}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) +
            R"(}],"bufferViews":[{"buffer":0,"byteLength":64,"byteStride":16},{"buffer":0,"byteOffset":64,"byteLength":)" +
            std::to_string(binary.size() - 64) + R"(}],"accessors":[)" + accessors + "]" + more + "}",
        binary);
}

constexpr const char* points = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4})";
constexpr const char* shorts = R"(,{"bufferView":1,"componentType":5123,"type":"SCALAR","count":6})";

TEST_F(LoadMesh, Gltf) {
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
    EXPECT_THAT(error_of("f.gltf", gltf(R"([{"children":[1,1]},{"mesh":0}])", "3")),
                HasSubstr("nodes[1] has two parents"));
    EXPECT_THAT(error_of("g.gltf", gltf(R"([{"mesh":-1}])", "3")),
                HasSubstr("nodes[0].mesh is to be a natural number"));
    EXPECT_THAT(error_of("h.glb", std::string("glTF\1\0\0\0", 8) + "xxxx"),
                HasSubstr("it is glTF 1; remedy: export glTF 2.0"));
}

TEST_F(LoadMesh, GltfThatIsNoJson) {
    EXPECT_THAT(error_of("a.gltf", "[]"), HasSubstr("it holds no glTF: its text is no JSON object; remedy: "));
    EXPECT_THAT(error_of("b.gltf", "{\n\"a\": x}"),
                HasSubstr("b.gltf:2: it holds no glTF: its text is no JSON object, it goes wrong at byte 8"));
    EXPECT_THAT(error_of("c.gltf", std::string(100000, '[')), HasSubstr("it goes wrong at byte 100001"));
    EXPECT_THAT(error_of("d.gltf", "{\"a\": 1e999}"), HasSubstr("a number of its JSON is too large"));
    EXPECT_THAT(error_of("e.gltf", "{}"), HasSubstr("it does not say that it is glTF 2"));
    EXPECT_EQ(load(write("f.gltf", gltf("[{\"mesh\":0,\"name\":\"M\xFCller\"}]", "3"))).triangles.size(), 1u);
}

TEST_F(LoadMesh, GltfModes) {
    const auto triangles = [&](const std::string& mode) {
        return load(write("a.glb",
                          square(R"({"attributes":{"POSITION":0},"indices":1)" + mode + "}",
                                 std::string(points) + shorts, "", bytes_of<std::uint16_t>({0, 1, 2, 3, 2, 1}))))
            .triangles;
    };
    EXPECT_EQ(triangles(""), (std::vector<Triangle>{{0, 1, 2}, {3, 2, 1}}));
    EXPECT_EQ(triangles(R"(,"mode":5)"), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 2}, {2, 3, 1}}));
    EXPECT_EQ(triangles(R"(,"mode":6)"), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 2}, {0, 2, 1}}));
    EXPECT_EQ(load(write("b.glb", square(R"({"attributes":{"POSITION":0},"mode":5})", points))).triangles,
              (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}))
        << "without indices";
    EXPECT_THAT(error_of("c.glb", square(R"({"attributes":{"POSITION":0},"mode":1})", points)),
                HasSubstr("there are no triangles in it"));
    EXPECT_THAT(error_of("d.glb", square(R"({"attributes":{"POSITION":0},"mode":7})", points)),
                HasSubstr("meshes[0].primitives[0] has the unknown mode 7"));
    EXPECT_THAT(error_of("e.glb", square(R"({"attributes":{"POSITION":0},"indices":1})", std::string(points) + shorts,
                                         "", bytes_of<std::uint16_t>({0, 1, 2, 3, 2, 4}))),
                HasSubstr("meshes[0].primitives[0].indices refers to vertex 4, but there are 4"));
    EXPECT_THAT(error_of("f.glb", square(R"({"attributes":{"POSITION":0},"indices":0})", points)),
                HasSubstr("meshes[0].primitives[0].indices is no accessor of unsigned scalars"));
}

TEST_F(LoadMesh, GltfSparseAccessors) {
    const std::string accessor =
        R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":1,)"
        R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":1,"byteOffset":4}}})";
    const std::string all = R"({"attributes":{"POSITION":0},"mode":5})";
    const std::string values = bytes_of<float>({8, 9, 10});
    const Mesh mesh = load(write("a.glb", square(all, accessor, "", std::string("\3\0\0\0", 4) + values)));
    EXPECT_EQ(mesh.vertices[3], (Vec3{8, 9, 10}));
    EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
    EXPECT_THAT(error_of("b.glb", square(all, accessor, "", std::string("\4\0\0\0", 4) + values)),
                HasSubstr("accessors[0].sparse.indices refers to element 4 of 4"));
    EXPECT_THAT(error_of("c.glb", square(all, accessor, "", std::string("\3\0\0\0", 4))),
                HasSubstr("accessors[0].sparse.values needs 16 bytes of bufferViews[1], which has 4"));
}

/// KHR_mesh_quantization.
TEST_F(LoadMesh, GltfIntegerPositions) {
    const auto vertex = [&](const std::string& type, const std::string& bytes) {
        const std::string accessor = R"({"bufferView":1,"type":"VEC3","count":3,"componentType":)" + type + "}";
        return load(write("a.glb", square(R"({"attributes":{"POSITION":0}})", accessor,
                                          R"(,"extensionsRequired":["KHR_mesh_quantization"])", bytes)))
            .vertices[1];
    };
    EXPECT_EQ(vertex("5120", bytes_of<std::int8_t>({0, 0, 0, -128, 127, 1, 0, 1, 0})), (Vec3{-128, 127, 1}));
    EXPECT_EQ(vertex("5120,\"normalized\":true", bytes_of<std::int8_t>({0, 0, 0, -128, 127, 0, 0, 1, 0})),
              (Vec3{-1, 1, 0}));
    EXPECT_EQ(vertex("5121,\"normalized\":true", bytes_of<std::uint8_t>({0, 0, 0, 255, 51, 0, 0, 1, 0})),
              (Vec3{1, 0.2, 0}));
    EXPECT_EQ(vertex("5122,\"normalized\":true", bytes_of<std::int16_t>({0, 0, 0, -32768, 32767, 0, 0, 1, 0})),
              (Vec3{-1, 1, 0}));
    EXPECT_EQ(vertex("5123", bytes_of<std::uint16_t>({0, 0, 0, 65535, 2, 3, 0, 1, 0})), (Vec3{65535, 2, 3}));
    EXPECT_THAT(error_of("b.glb", square(R"({"attributes":{"POSITION":0}})",
                                         R"({"bufferView":0,"type":"VEC3","count":4,"componentType":5124})")),
                HasSubstr("accessors[0] has the unknown component type 5124"));
    EXPECT_THAT(error_of("c.glb", square(R"({"attributes":{"POSITION":0}})",
                                         R"({"bufferView":0,"type":"VEC2","count":4,"componentType":5126})")),
                HasSubstr("meshes[0].primitives[0].attributes.POSITION is to be an accessor of three floats"));
}

TEST_F(LoadMesh, GltfNodeTransforms) {
    const auto vertex = [&](const std::string& node) {
        return load(write("a.gltf", gltf("[{\"mesh\":0," + node + "}]", "3"))).vertices[1];
    };
    EXPECT_EQ(vertex(R"("matrix":[0,2,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1])"), (Vec3{5, 8, 7})) << "column by column";
    EXPECT_LT(distance(vertex(R"("rotation":[0,0,2,2],"scale":[3,1,1],"translation":[0,0,1])"), (Vec3{0, 3, 1})), 1e-12)
        << "scaled first, then turned; quaternions of any length";
    EXPECT_THAT(error_of("b.gltf", gltf(R"([{"mesh":0,"rotation":[0,0,0,0]}])", "3")),
                HasSubstr("nodes[0].rotation is no rotation"));
    EXPECT_THAT(error_of("c.gltf", gltf(R"([{"mesh":0,"scale":[1,1]}])", "3")),
                HasSubstr("nodes[0].scale is to be 3 numbers"));
    const Mesh mirrored = load(write("d.gltf", gltf(R"([{"mesh":0,"scale":[-1,1,1]}])", "3")));
    const auto& [a, b, c] = mirrored.triangles.at(0);
    EXPECT_GT(cross(mirrored.vertices[b] - mirrored.vertices[a], mirrored.vertices[c] - mirrored.vertices[a]).z, 0);
}

TEST_F(LoadMesh, GltfBuffersInFilesBesideIt) {
    std::string text = gltf(R"([{"mesh":0}])", "3");
    const std::size_t begin = text.find("data:"), end = text.find('"', begin);
    text.replace(begin, end - begin, "my%20part.bin");
    const auto file = write("a.gltf", text);
    EXPECT_THAT(error_of(file),
                HasSubstr("a.gltf: buffers[0].uri is the file " + (folder / "my part.bin").string() +
                          ", which cannot be read (there is no such file); remedy: copy it beside this file"));
    write("my part.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_THAT(error_of(file), HasSubstr("a.gltf: buffers[0] promises 36 bytes, but there are 32"));
    write("my part.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(load(file).triangles.size(), 1u);
    EXPECT_THAT(error_of("b.gltf", std::string(text).replace(begin, 13, "data:;base64,A!")),
                HasSubstr("buffers[0].uri is no data in base64"));
    loader = registry.make<MeshLoader>("load.mesh", {{"max_bytes", static_cast<std::int64_t>(text.size())}});
    write("my part.bin", std::string(text.size() + 1, '\0'));
    EXPECT_THAT(error_of(file), HasSubstr("bytes, more than "));
}

TEST_F(LoadMesh, GltfExtensions) {
    const std::string all = R"({"attributes":{"POSITION":0},"mode":5})";
    EXPECT_THAT(error_of("a.glb", square(all, points, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])")),
                HasSubstr("it needs the extension 'KHR_draco_mesh_compression', which is not read; remedy: "));
    EXPECT_EQ(
        load(write("b.glb", square(all, points, R"(,"extensionsRequired":["KHR_materials_unlit"])"))).triangles.size(),
        2u);
    EXPECT_THAT(
        error_of("c.glb", square(R"({"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{}}})",
                                 R"({"componentType":5126,"type":"VEC3","count":4})")),
        HasSubstr("meshes[0].primitives[0] is compressed (KHR_draco_mesh_compression), which is not read"));
}

TEST_F(LoadMesh, GltfExtensionsThatMayBelongToTheShape) {
    const std::string all = R"({"attributes":{"POSITION":0},"mode":5})";
    EXPECT_THAT(error_of("a.glb", square(all, points, R"(,"extensionsRequired":["ACME_inflated"])")),
                HasSubstr("it needs the extension 'ACME_inflated', which is not read; remedy: export without it"));
    const auto file = write("b.glb", square(all, points,
                                            R"(,"extensionsUsed":["ACME_inflated","KHR_materials_ior",)"
                                            R"("KHR_draco_mesh_compression","KHR_mesh_quantization"])"));
    EXPECT_EQ(load(file).triangles.size(), 2u);
    EXPECT_THAT(context.messages,
                ::testing::ElementsAre(file.string() + ": it uses the extension 'ACME_inflated', which is not read; "
                                                       "what that adds to the shape is left out"));
}

/// EXT_mesh_gpu_instancing: nodes[0] shows its mesh at every listed pose.
TEST_F(LoadMesh, GltfInstances) {
    // Accessors 1: two translations, 2: two rotations (none, a quarter turn about z), 3: two scales, 4: three scales.
    const std::string vec3 = R"({"bufferView":1,"componentType":5126,"type":"VEC3",)";
    const std::string accessors = std::string(points) + "," + vec3 + R"("count":2},)" +
                                  R"({"bufferView":1,"byteOffset":24,"componentType":5126,"type":"VEC4","count":2},)" +
                                  vec3 + R"("byteOffset":56,"count":2},)" + vec3 + R"("byteOffset":56,"count":3})";
    const std::string binary = bytes_of<float>({0,
                                                0,
                                                0,
                                                0,
                                                0,
                                                5,
                                                /* rotations */ 0,
                                                0,
                                                0,
                                                1,
                                                0,
                                                0,
                                                3,
                                                3,
                                                /* scales */ 1,
                                                1,
                                                1,
                                                4,
                                                -2,
                                                1,
                                                1,
                                                1,
                                                1});
    const auto scene = [&](const std::string& attributes) {
        std::string text = square(R"({"attributes":{"POSITION":0},"mode":5})", accessors,
                                  R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"])", binary);
        const std::string node = R"([{"mesh":0}])";
        const std::string with = R"([{"mesh":0,"translation":[0,0,100],"extensions":{"EXT_mesh_gpu_instancing":)"
                                 R"({"attributes":{)" +
                                 attributes + "}}}}]";
        const std::string json = text.substr(20, text.find("BIN") - 4 - 20);
        return glb(std::string(json).replace(json.find(node), node.size(), with), text.substr(text.find("BIN") + 4));
    };
    const Mesh mesh = load(write("a.glb", scene(R"("TRANSLATION":1,"ROTATION":2,"SCALE":3,"_ID":9)")));
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_THAT(mesh.vertices, ::testing::Contains(Vec3{1, 1, 100}));
    const auto near = [](const Vec3& p) {
        return ::testing::Contains(::testing::Truly([p](const Vec3& v) { return distance(v, p) < 1e-12; }));
    };
    EXPECT_THAT(mesh.vertices, near(Vec3{2, 4, 105})) << "(1,1) scaled to (4,-2), turned to (2,4)";
    const auto normal = [&](std::size_t t) {
        const auto& [a, b, c] = mesh.triangles[t];
        return cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z;
    };
    EXPECT_GT(normal(0), 0);
    EXPECT_GT(normal(2), 0) << "mirrored instances are turned round";
    EXPECT_EQ(load(write("b.glb", scene(R"("SCALE":4)"))).triangles.size(), 6u);
    EXPECT_THAT(error_of("c.glb", scene(R"("TRANSLATION":1,"SCALE":4)")),
                HasSubstr("EXT_mesh_gpu_instancing.attributes is to name accessors of the same count"));
    EXPECT_THAT(error_of("d.glb", scene(R"("ROTATION":1)")),
                HasSubstr("attributes.ROTATION is to be an accessor of four floats"));
}

/// Nodes that show one mesh share what was read of it.
TEST_F(LoadMesh, GltfManyNodesOfAPartWithManyUnusedPoints) {
    std::string nodes = R"([{"mesh":0,"children":[1)";
    std::string more;
    for (int i = 1; i <= 1000; ++i) {
        nodes += i > 1 ? "," + std::to_string(i) : "";
        more += R"(,{"mesh":0,"translation":[)" + std::to_string(i) + ",0,0]}";
    }
    std::string text = gltf(nodes + "]}" + more + "]", "3");
    // A million claimed points, three of them used: work for each node does not grow with the claim.
    const auto replace = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace(R"("primitives":[{"attributes":{"POSITION":0}}])",
            R"("primitives":[{"attributes":{"POSITION":0},"indices":1}])");
    replace(R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3})",
            R"("accessors":[{"componentType":5126,"type":"VEC3","count":1000000,"sparse":{"count":3,)"
            R"("indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},)"
            R"({"bufferView":1,"componentType":5121,"type":"SCALAR","count":3})");
    replace(R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36},{"buffer":1,"byteLength":3})");
    replace(R"(AAAAgD8AAAAA"}])", R"(AAAAgD8AAAAA"},{"byteLength":3,"uri":"data:;base64,AAEC"}])");
    EXPECT_EQ(load(write("a.gltf", text)).triangles.size(), 1001u);
}

TEST_F(LoadMesh, GltfWithoutScenesOrNodes) {
    const std::string text = gltf(R"([{"mesh":0}])", "3");
    const auto without = [](std::string from, const std::string& part) {
        return from.replace(from.find(part), part.size(), "");
    };
    const std::string no_scene = without(text, R"("scene":0,"scenes":[{"nodes":[0]}],)");
    EXPECT_EQ(load(write("a.gltf", no_scene)).triangles.size(), 1u);
    EXPECT_EQ(load(write("b.gltf", without(no_scene, R"("nodes":[{"mesh":0}],)"))).triangles.size(), 1u);
}

TEST_F(LoadMesh, GltfUnusedVerticesMayBeAnything) {
    const std::string nan = bytes_of<float>({std::nanf("")});
    std::string bytes =
        square(R"({"attributes":{"POSITION":0},"indices":1})",
               std::string(points) + R"(,{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3})", "",
               std::string("\0\1\2\0", 4));
    const std::size_t last = bytes.find(bytes_of<float>({1, 1, 0, 7}));
    EXPECT_EQ(load(write("a.glb", bytes.replace(last, 4, nan))).triangles.size(), 1u);
    EXPECT_THAT(error_of("b.glb", bytes.replace(last - 16, 4, nan)),
                HasSubstr("b.glb: meshes[0].primitives[0].attributes.POSITION: vertex 2 (counted from 0) is not "
                          "finite: (nan, 1, 0); remedy: "));
}

} // namespace
} // namespace foam::test
