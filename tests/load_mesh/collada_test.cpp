// COLLADA files written by the test: what is read, and what is refused with which words.
#include "fixture.hpp"
#include "scenes.hpp"

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* input =
    R"(<input semantic="VERTEX" source="#v" offset="1"/><input semantic="NORMAL" source="#n" offset="0"/>)";
constexpr const char* shown = R"(<node><instance_geometry url="#g"/></node>)";

std::string primitive(const std::string& kind, const std::string& content) {
    return "<" + kind + ">" + input + content + "</" + kind + ">";
}

TEST_F(LoadMesh, ColladaAppliesTheUnitAndNotTheUpAxis) {
    const Mesh mesh = load(write("a.dae", collada("<unit meter=\"0.01\"/><up_axis> Y_UP</up_axis>", "0 1 3", identity)));
    EXPECT_THAT(context.messages, ElementsAre(HasSubstr("a.dae: its up-axis 'Y_UP' is ignored, as RViz and MoveIt do")));
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(mesh.vertices[2], (Vec3{0, 1, 0}));
    EXPECT_EQ(load(write("b.dae", collada("", "0 1 2", identity))).vertices[1].x, 100) << "no unit: metres";
    for (const char* wrong : {"0", "-1", "nan", "inch", ""}) {
        EXPECT_THAT(
            error_of("c.dae", collada("\n<unit meter=\"" + std::string(wrong) + "\"/>", "0 1 2", identity)),
            HasSubstr("c.dae:3: the unit is to be a positive number of metres, got '" + std::string(wrong) + "'"));
    }
}

TEST_F(LoadMesh, ColladaPrimitives) {
    const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
    const auto triangles = [&](const std::string& primitives) {
        return load(write("a.dae", collada_scene("", primitives, shown))).triangles;
    };
    EXPECT_EQ(triangles(primitive("triangles", "<p>9 0 9 1 9 2 9 0 9 2 9 3</p>")), two);
    EXPECT_EQ(triangles(primitive("polylist", "<vcount>3 3</vcount><p>9 0 9 1 9 2 9 0 9 2 9 3</p>")), two);
    EXPECT_EQ(triangles(primitive("polylist", "<vcount>4</vcount><p>9 0 9 1 9 2 9 3</p>")).size(), 2u);
    EXPECT_EQ(triangles(primitive("polygons", "<p>9 0 9 1 9 2</p><p>9 0 9 2 9 3</p>")), two);
    EXPECT_EQ(triangles(primitive("tristrips", "<p>9 0 9 1 9 3 9 2</p>")),
              (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
    EXPECT_EQ(triangles(primitive("trifans", "<p>9 0 9 1 9 2 9 3</p>")), two);
    EXPECT_EQ(triangles(primitive("lines", "<p>9 0 9 1</p>") + primitive("triangles", "") +
                        primitive("triangles", "<p>9 0 <!-- a comment --> 9 1 9 2</p>")),
              (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_TRUE(context.messages.empty());
}

TEST_F(LoadMesh, ColladaFacesThatAreWrong) {
    const auto error = [&](const std::string& primitives) {
        return error_of("a.dae", collada_scene("", primitives, shown));
    };
    EXPECT_THAT(error(primitive("triangles", "<p>9 0 9 1 9 4</p>")),
                HasSubstr("a.dae:5: <p> refers to vertex 4, but there are 4 (the first is 0); remedy: "));
    EXPECT_THAT(error(primitive("triangles", "<p>9 0 9\nnan</p>")),
                HasSubstr("a.dae:6: <p> holds 'nan', which is no index"));
    EXPECT_THAT(error(primitive("triangles", "<p>9 0 9 1</p>")), HasSubstr("<p> ends within a triangle"));
    EXPECT_THAT(error(primitive("triangles", "<p>9 0 9</p>")),
                HasSubstr("<p> ends within a corner, which has 2 indices"));
    EXPECT_THAT(error(primitive("polylist", "<vcount>4000000000</vcount><p>9 0 9 1 9 2</p>")),
                HasSubstr("<p> ends within a polygon that <vcount> promises"));
    EXPECT_THAT(error(primitive("polylist", "<p>9 0 9 1 9 2</p>")), HasSubstr("a.dae:5: <polylist> has no <vcount>"));
    EXPECT_THAT(error("<triangles><input semantic=\"VERTEX\" source=\"#no\"/><p>0 1 2</p></triangles>"),
                HasSubstr("a.dae:5: <triangles> has no input of positions that is in the file"));
}

TEST_F(LoadMesh, ColladaPoints) {
    const std::string good = collada("", "0 1 2", identity);
    const auto with = [&](const std::string& old, const std::string& other) {
        std::string text = good;
        return text.replace(text.find(old), old.size(), other);
    };
    EXPECT_THAT(error_of("a.dae", with("100 100 0", "100 inf 0")),
                HasSubstr("a.dae:4: vertex 2 (counted from 0) of geometry 'g' is not finite: (100, inf, 0)"));
    EXPECT_EQ(load(write("b.dae", with("0 100 0<", "0 nan 0<"))).triangles.size(), 1u) << "no face uses that vertex";
    EXPECT_THAT(error_of("c.dae", with("100 100 0", "100 l00 0")),
                HasSubstr("c.dae:4: <float_array> holds 'l00', which is no number"));
    EXPECT_THAT(error_of("d.dae", with("count=\"4\"", "count=\"9\"")),
                HasSubstr("d.dae:4: the accessor needs 27 values, but 'a' has 12"));
    EXPECT_THAT(error_of("e.dae", with("stride=\"3\"", "stride=\"2\"")),
                HasSubstr("e.dae:4: the accessor's stride of 2 holds no X, Y and Z"));
    EXPECT_THAT(error_of("f.dae", with("stride=\"3\"", "stride=\"99999\"")),
                HasSubstr("stride='99999' cannot be true of a file of "));
    EXPECT_TRUE(context.messages.empty());
    EXPECT_EQ(load(write("g.dae", with("count=\"12\"", "count=\"4000000000\""))).triangles.size(), 1u);
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0],
                HasSubstr("g.dae:3: 'a' promises '4000000000' numbers, but holds 12, which are taken"));
}

/// The place of x, y and z among the numbers is what the names of the parameters say.
TEST_F(LoadMesh, ColladaParametersNameTheAxes) {
    std::string text = collada("", "0 1 2", identity);
    text.replace(text.find("name=\"X\""), 8, "name=\"Z\"");
    text.replace(text.rfind("name=\"Z\""), 8, "name=\"X\"");
    EXPECT_EQ(load(write("a.dae", text)).vertices[2], (Vec3{0, 100, 100}));
}

TEST_F(LoadMesh, ColladaMirroredNodesKeepTheOutside) {
    const Mesh mesh = load(write("a.dae", collada("", "0 1 2", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")));
    const auto& [a, b, c] = mesh.triangles.at(0);
    EXPECT_GT(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z, 0);
}

TEST_F(LoadMesh, ColladaTransforms) {
    const auto third_vertex = [&](const std::string& transforms) {
        const std::string node = "<node>" + transforms + R"(<instance_geometry url="#g"/></node>)";
        return load(write("a.dae", collada_scene("", primitive("triangles", "<p>9 0 9 1 9 2</p>"), node))).vertices[2];
    };
    const auto expect = [&](const std::string& transforms, const Vec3& expected) {
        EXPECT_LT(distance(third_vertex(transforms), expected), 1e-10) << transforms;
    };
    expect("<translate>1 2 3</translate><scale>2 1 1</scale>", {201, 102, 3});
    expect("<scale>2 1 1</scale><translate>1 2 3</translate>", {202, 102, 3});
    expect("<rotate>0 0 2 90</rotate>", {-100, 100, 0});
    expect("<rotate>0 0 0 90</rotate>", {100, 100, 0});
    expect("<lookat>0 0 5  0 0 0  0 1 0</lookat>", {100, 100, 5});
    expect("<lookat>5 0 0  0 0 0  0 1 0</lookat>", {5, 100, -100});
    expect("<skew>45 0 1 0 1 0 0</skew>", {200, 100, 0});
    EXPECT_THAT(error_of("b.dae", collada("", "0 1 2", "1 0 0")),
                HasSubstr("b.dae:7: <matrix> holds 3 numbers, 16 are needed; remedy: "));
    EXPECT_THAT(error_of("c.dae", collada("", "0 1 2", "1e300 0 0 0 0 1e308 0 0 0 0 1e300 0 0 0 0 1")),
                HasSubstr("is not finite where its node puts it: ("));
}

TEST_F(LoadMesh, ColladaInstances) {
    const std::string face = primitive("triangles", "<p>9 0 9 1 9 2</p>");
    const auto read = [&](const std::string& nodes, const std::string& libraries) {
        return load(write("a.dae", collada_scene("", face, nodes, libraries)));
    };
    const std::string library =
        R"(<library_nodes><node id="n"><translate>0 0 7</translate><instance_geometry url="#g"/></node></library_nodes>)";
    EXPECT_EQ(
        read(R"(<node><translate>1 0 0</translate><instance_node url="#n"/><instance_node url="#n"/></node>)", library)
            .triangles.size(),
        2u);
    EXPECT_EQ(read(R"(<node><translate>1 0 0</translate><instance_node url="#n"/></node>)", library).vertices[0],
              (Vec3{1, 0, 7}));
    EXPECT_TRUE(context.messages.empty());
    EXPECT_EQ(
        read(
            R"(<node><instance_controller url="#c"/></node>)",
            R"(<library_controllers><controller id="c"><skin source="#m"/></controller><controller id="m"><morph source="#g"/></controller></library_controllers>)")
            .triangles.size(),
        1u);
    ASSERT_EQ(context.messages.size(), 1u);
    EXPECT_THAT(context.messages[0], HasSubstr("it has skinned or morphed parts"));
    EXPECT_EQ(read(std::string(shown) + R"(<node><instance_geometry url="#gone"/></node>)", "").triangles.size(), 1u);
    EXPECT_THAT(context.messages.back(),
                HasSubstr("a.dae:7: <instance_geometry> shows '#gone', which this file does not hold; it is left out"));
}

TEST_F(LoadMesh, ColladaInstancesOfThemselvesEnd) {
    EXPECT_THAT(error_of("a.dae", collada_scene("", "", R"(<node id="n"><instance_node url="#n"/></node>)")),
                HasSubstr("a.dae:7: nodes lie more than 200 deep or are shown more than 1000000 times; remedy: "));
    std::string library = "<library_nodes>"; // 3^30 nodes
    for (int i = 0; i < 30; ++i) {
        const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
        library += "<node id=\"n" + std::to_string(i) + "\">" + next + next + next + "</node>";
    }
    library += "<node id=\"n30\"/></library_nodes>";
    EXPECT_THAT(error_of("b.dae", collada_scene("", "", R"(<node><instance_node url="#n0"/></node>)", library)),
                HasSubstr("or are shown more than 1000000 times"));
}

TEST_F(LoadMesh, ColladaWithoutASceneGivesAllGeometries) {
    std::string text = collada("", "0 1 2", identity);
    const std::size_t begin = text.find("<library_visual_scenes>"), end = text.find("</COLLADA>");
    EXPECT_EQ(load(write("a.dae", text.substr(0, begin) + text.substr(end))).triangles.size(), 1u);
    const std::string scene = "<scene><instance_visual_scene url=\"#sc\"/></scene>";
    EXPECT_EQ(load(write("b.dae", std::string(text).replace(text.find(scene), scene.size(), ""))).triangles.size(), 1u);
}

TEST_F(LoadMesh, ColladaTextOfAllSorts) {
    const std::string text = collada("<authoring_tool>M\xFCller &amp; S\xF6hne</authoring_tool>", "0 1 2", identity);
    EXPECT_EQ(load(write("a.dae", text)).triangles.size(), 1u) << "bytes that are no UTF-8";
    EXPECT_EQ(load(write("b.dae", "\n" + text)).triangles.size(), 1u) << "a line before the declaration";
    EXPECT_EQ(load(write("c.dae", "\xEF\xBB\xBF" + text)).triangles.size(), 1u) << "a byte order mark";
    EXPECT_THAT(error_of("d.dae", "<html/>"), HasSubstr("it holds no COLLADA: there is no element <COLLADA>"));
    EXPECT_THAT(error_of("e.dae", "<x>COLLADA</x>"), HasSubstr("it holds no COLLADA: there is no element <COLLADA>"));
    EXPECT_THAT(error_of("f.dae", text.substr(0, text.find("</visual_scene>"))),
                HasSubstr("f.dae:8:1: XML: no element found"));
}

} // namespace
} // namespace foam::test
