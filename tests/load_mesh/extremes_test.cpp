// Every format alike: parts far away and tiny ones keep their digits, limits hold.
#include "fixture.hpp"
#include "scenes.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;

struct Extreme {
    std::string name, text;
};

/// Two triangles with a corner at `x` on the x-axis; in scenes a node puts it there.
std::vector<Extreme> files_with(const std::string& x) {
    const std::string corners = x + " 0 0\n0 1 0\n0 0 1\n0 2 2\n";
    const std::string facets =
        "facet normal 0 0 0 outer loop vertex " + x +
        " 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet\n"
        "facet normal 0 0 0 outer loop vertex 0 2 2 vertex 0 1 0 vertex 0 0 1 endloop endfacet\n";
    std::string two_nodes = gltf(R"([{"children":[1,2]},{"mesh":0,"translation":[)" + x + R"(,0,0]},{"mesh":0}])", "3");
    return {
        {"a.obj", "v " + x + " 0 0\nv 0 1 0\nv 0 0 1\nv 0 2 2\nf 1 2 3\nf 4 2 3\n"},
        {"b.off", "OFF\n4 2 0\n" + corners + "3 0 1 2\n3 3 1 2\n"},
        {"c.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                  "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                      corners + "3 0 1 2\n3 3 1 2\n"},
        {"d.stl", "solid\n" + facets + "endsolid\n"},
        {"e.dae", collada("", "0 1 2 0 2 3", "1 0 0 " + x + " 0 1 0 0 0 0 1 0 0 0 0 1")},
        {"f.gltf", two_nodes}};
}

TEST_F(LoadMesh, FarAndTinyPartsKeepTheirDigits) {
    // 10 km and a nanometre; a tenth of a micrometre and some.
    for (const char* x : {"10000.000000001", "-10000.000000123", "1.25e-07", "3.0000000001e-12"}) {
        const double expected = std::stod(x);
        for (const Extreme& file : files_with(x)) {
            SCOPED_TRACE(file.name + " " + x);
            const Mesh mesh = load(write(file.name, file.text));
            EXPECT_EQ(mesh.triangles.size(), 2u);
            EXPECT_EQ(mesh.vertices.at(0).x, expected);
        }
    }
}

TEST_F(LoadMesh, EveryFormatKeepsTheLimitOfTriangles) {
    for (const Extreme& file : files_with("1")) {
        SCOPED_TRACE(file.name);
        loader = registry.make<MeshLoader>("load.mesh", {{"max_triangles", std::int64_t{2}}});
        EXPECT_EQ(load(write(file.name, file.text)).triangles.size(), 2u);
        loader = registry.make<MeshLoader>("load.mesh", {{"max_triangles", std::int64_t{1}}});
        EXPECT_THAT(error_of(file.name, file.text), HasSubstr("1 triangle"));
        loader = registry.make<MeshLoader>("load.mesh", {{"max_bytes", std::int64_t{20}}});
        EXPECT_THAT(error_of(file.name, file.text), HasSubstr("bytes, more than 20; remedy: "));
    }
}

} // namespace
} // namespace foam::test
