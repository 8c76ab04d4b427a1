// What load.urdf takes though it is wrong, because other readers do, and what it says of it.
#include "loading.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <foam/robot/robot.hpp>

#include <fstream>
#include <iterator>
#include <map>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What is loaded, with foam's own warnings.
struct Loaded {
    Robot robot;
    std::vector<std::string> warnings;
};

/// Returns the robot of a text whose source is `source`.
Loaded loaded_as(const std::string& text, const std::string& source, const fs::path& file = "/none/robot.urdf") {
    ListeningContext context;
    Loaded result{load_text(text, context, file), {}};
    for (const std::string& message : context.messages) {
        if (message.find("urdfdom") == message.npos) {
            result.warnings.push_back(message);
        }
    }
    EXPECT_EQ(result.robot.source, source);
    return result;
}

Loaded loaded(const std::string& text, const fs::path& file = "/none/robot.urdf") {
    return loaded_as(text, text, file);
}

const std::string document = "<?xml version='1.0'?>\n<robot name='r'>\n<link name='a'><collision><geometry>"
                             "<box size='1 1 1'/></geometry></collision></link></robot>";

Loaded with_geometry(const std::string& geometry, const std::string& origin = "") {
    return loaded("<robot name='r'><link name='a'>\n<collision>" + origin + "<geometry>" + geometry +
                  "</geometry></collision></link></robot>");
}

Loaded with_joint(const std::string& inside) {
    return loaded("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
                  "<child link='b'/>\n" +
                  inside + "</joint></robot>");
}

const std::string mark = "\xEF\xBB\xBF", nul(1, '\0');

TEST(LoadUrdfTolerance, WhatStandsBeforeTheDocument) {
    for (const std::string& before : {std::string("\n"), std::string("  \r\n\t"), mark + "\n", "\n" + mark, nul,
                                      std::string("<!-- c -->\n")}) {
        const Loaded one = loaded(before + document);
        const int line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 3;
        EXPECT_EQ(one.robot.links.at(0).collisions.at(0).line, line);
        EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("/none/robot.urdf:1: something stands before the XML "
                                                        "declaration; remedy: let the file begin with <?xml")));
    }
    EXPECT_THAT(loaded(mark + document).warnings, IsEmpty());
    EXPECT_THAT(loaded("\n" + mark + document.substr(document.find('\n') + 1)).warnings,
                ElementsAre(HasSubstr("a NUL or a byte order mark stands before the document")));
}

TEST(LoadUrdfTolerance, WhatStandsAfterTheDocument) {
    for (const std::string& after : {nul, "\n" + nul + nul + "\n", mark, nul + "junk<a>", std::string("\njunk"),
                                     "\n" + document}) {
        EXPECT_THAT(loaded(document + after).warnings,
                    ElementsAre("/none/robot.urdf:3: what follows </robot> is not read; remedy: let the file end "
                                "there"));
    }
    EXPECT_THAT(loaded(document + "\n<!-- end -->\n").warnings, IsEmpty());
}

TEST(LoadUrdfTolerance, XmlThatIsNotWellFormed) {
    EXPECT_THAT(loaded("<robot name='r'>\n<!-- a -- b ---><link name='a'/></robot>").warnings,
                ElementsAre("/none/robot.urdf:2: a comment has '--' in it; remedy: write one '-'"));
    const Loaded ampersand = loaded("<robot name='r&amp;d'>\n<link name='a&b & c'/></robot>");
    EXPECT_EQ(ampersand.robot.links.at(0).name, "a&b & c");
    EXPECT_EQ(ampersand.robot.name, "r&d");
    EXPECT_THAT(ampersand.warnings,
                ElementsAre("/none/robot.urdf:2: a '&' begins no entity; remedy: write &amp;"));
    EXPECT_THAT(loaded("<robot name='r'><!-- \xE9 --><link name='a'/></robot>").warnings,
                ElementsAre("/none/robot.urdf:1: the text is not UTF-8; remedy: iconv -f ENCODING -t UTF-8"));
    EXPECT_THAT(loaded("<?xml version='1.0' encoding='utf8'?><robot name='\xC3\xA9'><link name='a'/></robot>").robot.name,
                "\xC3\xA9");
}

/// Returns the text in an encoding of `width` bytes a unit.
std::string encoded(const std::u32string& text, std::size_t width, bool big) {
    std::string result;
    const auto put = [&](char32_t unit) {
        for (std::size_t i = 0; i < width; ++i) {
            result += static_cast<char>(unit >> (8 * (big ? width - 1 - i : i)) & 0xFF);
        }
    };
    for (const char32_t point : text) {
        if (width == 2 && point > 0xFFFF) {
            put(0xD800 + ((point - 0x10000) >> 10));
            put(0xDC00 + ((point - 0x10000) & 0x3FF));
        } else {
            put(point);
        }
    }
    return result;
}

TEST(LoadUrdfTolerance, Utf16AndUtf32) {
    const std::u32string after = U"?>\n<robot name='r'>\n<link name='t\u00EAte \U0001F916'/></robot>\n";
    const std::string body = "?>\n<robot name='r'>\n<link name='t\xC3\xAAte \xF0\x9F\xA4\x96'/></robot>\n";
    for (const std::size_t width : {2U, 4U}) {
        for (const bool big : {false, true}) {
            const std::string name = width == 2 ? "UTF-16" : "UTF-32";
            for (const std::u32string& start : {std::u32string(U"\uFEFF<?xml version='1.0' encoding='UTF-16'"),
                                                std::u32string(U"\uFEFF<?xml version='1.0' encoding='utf-8'"),
                                                std::u32string(U"\uFEFF<?xml version='1.0'"),
                                                std::u32string(U"<?xml version='1.0' encoding=\"UTF-16LE\""),
                                                std::u32string(U"<?xml version='1.0'")}) {
                const std::string quote = start.find(U'"') != start.npos ? "\"" : "'";
                const std::string declared =
                    start.find(U"encoding") == start.npos ? "" : " encoding=" + quote + "UTF-8" + quote;
                const Loaded one =
                    loaded_as(encoded(start + after, width, big), "<?xml version='1.0'" + declared + body);
                EXPECT_EQ(one.robot.links.at(0).name, "t\xC3\xAAte \xF0\x9F\xA4\x96");
                EXPECT_THAT(one.warnings,
                            ElementsAre("/none/robot.urdf:1: the text is " + name +
                                        ", which ROS cannot read; what foam writes of it is UTF-8; remedy: iconv -f " +
                                        name +
                                        (start[0] == U'\uFEFF' ? ""
                                         : big                 ? "BE"
                                                               : "LE") +
                                        " -t UTF-8, and encoding=\"UTF-8\""));
            }
        }
    }
    EXPECT_EQ(loaded_as(encoded(U"<robot name='r'><link name='a'/></robot>", 2, false) + "x",
                        "<robot name='r'><link name='a'/></robot>")
                  .robot.links.size(),
              1);
    EXPECT_THAT(
        loaded("<?xml version='1.0' encoding='UTF-16'?>\n<robot name='\xC3\xA9'><link name='a'/></robot>").warnings,
        ElementsAre("/none/robot.urdf:1: the text is UTF-8, and not 'utf-16' as it says; remedy: "
                    "encoding=\"UTF-8\""));
}

/// Returns the warnings of several roots, and checks where the links are.
std::vector<std::string> warnings_of_roots(const std::string& text, const std::string& root,
                                           const std::map<std::string, double>& heights) {
    const Loaded one = loaded(text);
    EXPECT_EQ(one.robot.root, root);
    const auto poses = link_poses(one.robot);
    EXPECT_EQ(poses.size(), heights.size());
    for (const auto& [link, height] : heights) {
        EXPECT_EQ(poses.at(link).translation.z, height) << link;
    }
    return one.warnings;
}

TEST(LoadUrdfTolerance, SeveralRoots) {
    const std::string joint =
        "<joint name='j' type='fixed'><origin xyz='0 0 1'/><parent link='b'/><child link='c'/></joint>";
    EXPECT_THAT(
        warnings_of_roots("<robot name='r'>\n<link name='a'/>\n<link name='b'/><link name='c'/>" + joint + "</robot>",
                          "a", {{"a", 0}, {"b", 0}, {"c", 1}}),
        ElementsAre("/none/robot.urdf:3: no joint leads to link 'b', nor to 'a'; read as fixed to 'a' with "
                    "equal frames, as MuJoCo places them; ROS refuses several roots; remedy: a fixed joint "
                    "from 'a' to 'b'"));
    EXPECT_THAT(
        warnings_of_roots("<robot name='r'>\n<link name='a'/>\n<link name='world'/><link name='c'/>\n"
                          "<joint name='a_to_c' type='fixed'><parent link='world'/><child link='a'/></joint>"
                          "</robot>",
                          "world", {{"a", 0}, {"world", 0}, {"c", 0}}),
        ElementsAre(HasSubstr(":3: no joint leads to link 'c', nor to 'world'; read as fixed to 'world' with")));
    EXPECT_THAT(loaded("<robot name='r'><link name='a'/><link name='b'/><link name='c'/></robot>").warnings,
                ElementsAre(HasSubstr("no joint leads to link 'b' and 1 more, nor to 'a'")));
    const Loaded named = loaded("<robot name='r'><link name='a'/><link name='b'/><link name='c'/><joint name='a_to_c' "
                                "type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
    EXPECT_EQ(named.robot.joints.size(), 2);
    EXPECT_EQ(named.robot.joints.at(1).name, "a_to_c_2");
}

TEST(LoadUrdfTolerance, CollisionsWithoutGeometry) {
    for (const char* nothing : {"<collision/>", "<collision name='n'><origin/><geometry/></collision>"}) {
        const Loaded one = loaded("<robot name='r'><link name='a'>\n" + std::string(nothing) + "</link></robot>");
        EXPECT_THAT(one.robot.links.at(0).collisions, IsEmpty());
        EXPECT_THAT(one.warnings, ElementsAre("/none/robot.urdf:2: a <collision> without geometry is left out; remedy: "
                                              "remove it"));
    }
}

TEST(LoadUrdfTolerance, PlaceholdersAndFlatShapes) {
    for (const char* nothing : {"<sphere radius='0.00'/>", "<box size='0 0 0'/>", "<cylinder radius='0' length='0'/>"}) {
        const Loaded placeholder = with_geometry(nothing);
        EXPECT_THAT(placeholder.robot.links.at(0).collisions, IsEmpty());
        EXPECT_THAT(placeholder.warnings, ElementsAre(HasSubstr("/none/robot.urdf:2: a <")));
        EXPECT_THAT(placeholder.warnings, ElementsAre(HasSubstr("> without size is left out; remedy: remove its "
                                                                "element, or give it a size")));
    }
    const Loaded flat = with_geometry("<box size='1 0 1'/>");
    EXPECT_EQ(std::get<Element>(flat.robot.links.at(0).collisions.at(0).geometry), Element::box({1, 1e-6, 1}));
    EXPECT_THAT(flat.warnings, ElementsAre("/none/robot.urdf:2: a flat <box> is read 0.001 mm thick; remedy: give it a "
                                           "thickness"));
    EXPECT_THAT(with_geometry("<plane normal='0 0 1'/>").warnings,
                ElementsAre("/none/robot.urdf:2: a <plane> stays in the file, and no element covers it"));
}

TEST(LoadUrdfTolerance, TheFirstOfTwoCounts) {
    const Loaded shapes = with_geometry("<sphere radius='1'/><box size='1 1 1'/>", "<origin xyz='1 0 0'/><origin/>");
    EXPECT_EQ(std::get<Element>(shapes.robot.links.at(0).collisions.at(0).geometry), Element::sphere(1));
    EXPECT_EQ(shapes.robot.links.at(0).collisions.at(0).origin.translation.x, 1);
    EXPECT_THAT(shapes.warnings, ElementsAre("/none/robot.urdf:2: a second shape, <box>, in one <geometry> is not "
                                             "read; remedy: give it a <collision> of its own",
                                             "/none/robot.urdf:2: a second <origin> in <collision> is not read; "
                                             "remedy: keep one"));
    const Loaded axes = with_joint("<axis xyz='0 0 1'/><axis xyz='0 1 0'/>");
    EXPECT_EQ(axes.robot.joints.at(0).axis, (Vec3{0, 0, 1}));
    EXPECT_THAT(axes.warnings,
                ElementsAre("/none/robot.urdf:2: a second <axis> in <joint> is not read; remedy: keep one"));
}

TEST(LoadUrdfTolerance, Numbers) {
    EXPECT_THAT(with_geometry("<sphere radius='1'/>", "<origin xyz='1 2 3 4' rpy=''/>").warnings,
                ElementsAre("/none/robot.urdf:2: <origin xyz=\"1 2 3 4\"> has 4 numbers, of which the first three "
                            "count; remedy: xyz=\"1 2 3\"",
                            "/none/robot.urdf:2: <origin rpy=\"\"> counts as absent; remedy: remove rpy"));
    for (const char* commas : {"<box size='1,2,3'/>", "<box size='1, 2, 3'/>", "<box size='1, 2 3'/>"}) {
        const Loaded box = with_geometry(commas);
        EXPECT_EQ(std::get<Element>(box.robot.links.at(0).collisions.at(0).geometry), Element::box({1, 2, 3}));
        EXPECT_THAT(box.warnings, ElementsAre(HasSubstr("has commas between its numbers; remedy: size=\"1 2 3\"")));
    }
    const Loaded mesh = with_geometry("<mesh filename='a.stl' scale='0.5'/>");
    EXPECT_EQ(std::get<MeshReference>(mesh.robot.links.at(0).collisions.at(0).geometry).scale, (Vec3{0.5, 0.5, 0.5}));
    EXPECT_THAT(mesh.warnings,
                ElementsAre("/none/robot.urdf:2: <mesh scale=\"0.5\"> has one number; remedy: scale=\"0.5 0.5 0.5\""));
    const Pose turned = with_geometry("<box size='1 1 1'/>", "<origin quat_xyzw='0 0 0.70710678118654752 "
                                                             "0.70710678118654752'/>")
                            .robot.links.at(0)
                            .collisions.at(0)
                            .origin;
    EXPECT_NEAR(distance(turned * Vec3{1, 0, 0}, {0, 1, 0}), 0, 1e-15);
}

TEST(LoadUrdfTolerance, Joints) {
    const Loaded still = with_joint("<axis xyz='0 0 0'/>");
    EXPECT_EQ(still.robot.joints.at(0).kind, Joint::Kind::fixed);
    EXPECT_THAT(still.warnings, ElementsAre("/none/robot.urdf:2: the axis of joint 'j' is zero, so it does not move; "
                                            "remedy: type=\"fixed\""));
    const Loaded endless = with_joint("<limit effort='1' velocity='1' lower='-inf' upper='inf'/>");
    EXPECT_FALSE(endless.robot.joints.at(0).limited);
    EXPECT_THAT(endless.warnings, ElementsAre("/none/robot.urdf:2: <limit> is infinite, so the joint is read without "
                                              "limits"));
    const Loaded point = with_joint("<limit effort='1' velocity='1' lower='-1.57.' upper='1'/>");
    EXPECT_EQ(point.robot.joints.at(0).lower, -1.57);
    EXPECT_THAT(point.warnings, ElementsAre("/none/robot.urdf:2: <limit lower=\"-1.57.\"> is read as -1.57; remedy: "
                                            "lower=\"-1.57\""));
    const Loaded variable = with_joint("<origin xyz='$(optenv IMU_XYZ 0.19 0 0.149)'/>");
    EXPECT_EQ(variable.robot.joints.at(0).origin.translation, (Vec3{0.19, 0, 0.149}));
    EXPECT_THAT(variable.warnings, ElementsAre(HasSubstr("is read as \"0.19 0 0.149\"; remedy: run xacro first")));
    const Loaded shouted =
        loaded("<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='Revolute'><parent "
               "link='a'/><child link='b'/></joint></robot>");
    EXPECT_EQ(shouted.robot.joints.at(0).kind, Joint::Kind::revolute);
    EXPECT_THAT(shouted.warnings,
                ElementsAre("/none/robot.urdf:2: <joint type=\"Revolute\"> is read as revolute; remedy: "
                            "type=\"revolute\""));
    const Loaded world = loaded("<robot name='r'><link name='a'/><joint name='j' type='fixed'>\n<parent link='world'/>"
                                "<child link='a'/></joint></robot>");
    EXPECT_EQ(world.robot.root, "world");
    EXPECT_THAT(world.warnings, ElementsAre("/none/robot.urdf:2: there is no link 'world'; it is added; remedy: <link "
                                            "name=\"world\"/>"));
}

TEST(LoadUrdfTolerance, SameWarningsAreOne) {
    EXPECT_THAT(loaded("<robot name='r'><link name='a'>\n<collision><geometry><sphere radius='0'/></geometry></collision>"
                       "\n<collision><geometry><sphere radius='0'/></geometry></collision></link></robot>")
                    .warnings,
                ElementsAre(HasSubstr(":2: a <sphere> without size is left out; remedy: remove its element, or give it "
                                      "a size (1 more, the next in line 3)")));
}

class LoadUrdfReferences : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"ws/arm/meshes/Link.stl", "ws/arm/urdf/beside.stl", "ws/other_folder/a.stl"}) {
            fs::create_directories((temporary.path() / name).parent_path());
            std::ofstream(temporary.path() / name) << "solid";
        }
        std::ofstream(temporary.path() / "ws/other_folder/package.xml") << "<package><name>hand</name></package>";
        fs::create_directories(temporary.path() / "ws/arm/urdf");
    }
    /// Returns the file that a mesh is found at, and keeps the warnings.
    fs::path found(const std::string& reference) {
        const Loaded robot = loaded("<robot name='r'><link name='a'>\n<collision><geometry><mesh filename='" +
                                        reference + "'/></geometry></collision></link></robot>",
                                    temporary.path() / "ws/arm/urdf/arm.urdf");
        warnings = robot.warnings;
        return std::get<MeshReference>(robot.robot.links.at(0).collisions.at(0).geometry)
            .path.lexically_relative(temporary.path());
    }
    const TemporaryFolder temporary;
    std::vector<std::string> warnings;
};

TEST_F(LoadUrdfReferences, AreReadAsTheyAreMeant) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"package:///arm/meshes/Link.stl", "it has more than two slashes before the package"},
        {"package://beside.stl", "it names no package"},
        {"package://robot/meshes/Link.stl", "no package 'robot' is found"},
        {"meshes/Link.stl", "it leads from another folder"},
        {"/arm/meshes/Link.stl", "it leads from another folder"},
        {"..\\meshes\\Link.stl", "it has backslashes"},
        {" ../meshes/Link.stl ", "it has blanks around it"},
        {"../Meshes/link.STL", "the case of its letters is another"},
        {"package://arm/meshes/link.stl", "the case of its letters is another"}};
    for (const auto& [reference, fault] : cases) {
        const fs::path file = found(reference);
        EXPECT_TRUE(file.filename() == "Link.stl" || file.filename() == "beside.stl") << reference;
        EXPECT_THAT(warnings, ElementsAre(testing::AllOf(HasSubstr("arm.urdf:2: mesh '" + reference), HasSubstr(fault),
                                                         HasSubstr("; remedy: filename=\""))))
            << reference;
    }
    EXPECT_EQ(found("package://hand/a.stl"), "ws/other_folder/a.stl") << "by its package.xml";
    EXPECT_THAT(warnings, IsEmpty());
    EXPECT_EQ(found("package://arm/meshes/Link.stl"), "ws/arm/meshes/Link.stl");
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(LoadUrdfReferences, AMissingMeshIsForThoseWhoNeedIt) {
    const Loaded robot = loaded("<robot name='r'><link name='a'>\n<collision><geometry><mesh "
                                "filename='package://pkg/a.stl'/></geometry></collision></link></robot>");
    const auto& mesh = std::get<MeshReference>(robot.robot.links.at(0).collisions.at(0).geometry);
    EXPECT_THAT(mesh.problem, HasSubstr("/none/robot.urdf:2: mesh 'package://pkg/a.stl' of link 'a' is not found; "
                                        "tried:\n  /none/pkg/a.stl\n  /pkg/a.stl"));
    EXPECT_THAT(mesh.problem, HasSubstr("\nremedy: --package pkg=FOLDER, where FOLDER is the package, or "
                                        "FOAM_PACKAGE_PATH=FOLDER, where FOLDER/pkg is it"));
}

TEST_F(LoadUrdfReferences, AXacroExpressionIsAMissingMesh) {
    const Loaded robot = loaded("<robot name='r'><link name='a'>\n<collision><geometry><mesh "
                                "filename='$(arg folder)/a.stl'/></geometry></collision></link></robot>");
    EXPECT_EQ(std::get<MeshReference>(robot.robot.links.at(0).collisions.at(0).geometry).problem,
              "/none/robot.urdf:2: mesh '$(arg folder)/a.stl' of link 'a' is not found; it is a xacro expression; "
              "remedy: run xacro first: xacro IN.xacro > OUT.urdf");
}

TEST(LoadUrdfTolerance, CasesOfTheField) {
    const fs::path folder = fs::path(FOAM_TEST_SOURCE) / "tests/load_urdf/tolerance";
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".urdf") {
            std::ifstream stream(entry.path(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            EXPECT_THAT(loaded(text, entry.path()).warnings, testing::SizeIs(1)) << entry.path();
        }
    }
}

} // namespace
} // namespace foam::test
