// What load.urdf refuses, and what it says.
#include "loading.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using testing::HasSubstr;

/// The message of the Error(input) that loading throws; empty if it does not.
std::string refusal(const std::string& text) {
    try {
        load_text(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return {};
}

/// A robot of one link whose collision geometry, in line 2, is `geometry`.
std::string refusal_of_geometry(const std::string& geometry, const std::string& origin = "") {
    return refusal("<robot name='r'><link name='a'>\n<collision>" + origin + "<geometry>" + geometry +
                   "</geometry></collision></link></robot>");
}

struct Case {
    const char* name;
    const char* text;
    const char* message;
};

void PrintTo(const Case& value, std::ostream* stream) {
    *stream << value.name;
}

const Case cases[] = {
    {"Empty", "", "/none/robot.urdf:1:1: XML: no element found"},
    {"NotXml", "solid\nfacet", "/none/robot.urdf:1:1: XML: syntax error"},
    {"Unclosed", "<robot name='r'>\n<link name='a'>\n</robot>",
     "/none/robot.urdf:3:3: XML: mismatched tag; remedy: close each <NAME> by </NAME>, the inner ones first"},
    {"CutShort", "<robot name='r'>\n<link name='a'/>\n",
     "/none/robot.urdf:3:1: XML: no element found; the file ends too early; remedy: get the whole file, or close what "
     "is open"},
    {"LessInValue", "<robot name='a<b'/>",
     "/none/robot.urdf:1:15: XML: not well-formed (invalid token); remedy: values in quotes, a blank between "
     "attributes, &lt; for '<' in a value, no control characters"},
    {"SameAttributeTwice", "<robot name='r' name='s'/>",
     "/none/robot.urdf:1:17: XML: duplicate attribute; remedy: keep one"},
    {"OwnEntity", "<!DOCTYPE robot [<!ENTITY l '<link/>'>]><robot name='r'>&l;</robot>", "an entity of its own, 'l'"},
    {"Sdf", "<sdf/>", "robot.urdf:1: this is an SDF file, not a URDF"},
    {"OtherRoot", "<model/>", "the root element of a URDF is <robot>, not <model>"},
    {"Xacro", "<robot name='r' xmlns:xacro='x'>\n<xacro:arg name='x'/></robot>",
     "robot.urdf:2: <xacro:arg>: this is a xacro file; run xacro first"},
    {"XacroExpression", "<robot name='r'>\n<link name='${prefix}a'/></robot>",
     "robot.urdf:2: <link name=\"${prefix}a\"> is a xacro"},
    {"NoLinks", "<robot name='r'/>",
     "the robot has no links; remedy: a <link>, or of a file of macros the file that uses them"},
    {"LinkWithoutName", "<robot name='r'>\n\n<link/></robot>", "robot.urdf:3: <link> has no name"},
    {"SameLinkTwice", "<robot name='r'>\n<link name='a'/>\n<link name='a'/></robot>",
     "robot.urdf:3: a second link 'a'; the first is in line 2; remedy: give it another name, or remove one"},
    {"UnknownParent",
     "<robot name='r'><link name='a'/><joint name='j' type='fixed'>\n<parent link='b'/><child "
     "link='a'/></joint></robot>",
     "robot.urdf:2: joint 'j' names link 'b' as parent, but there is no such link; did you mean 'a'?"},
    {"NameWithBlanks",
     "<robot name='r'><link name=' base '/><link name='a'/><joint name='j' type='fixed'>\n<parent link='base'/><child "
     "link='a'/></joint></robot>",
     "robot.urdf:2: joint 'j' names link 'base' as parent, but there is no such link; did you mean ' base '?"},
    {"JointWithoutChild",
     "<robot name='r'><link name='a'/><joint name='j' type='fixed'><parent link='a'/></joint></robot>",
     "joint 'j' has no <child>"},
    {"UnknownJointType", "<robot name='r'><link name='a'/><joint name='j' type='ball'/></robot>",
     "unknown joint type 'ball'"},
    {"Circle",
     "<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='fixed'><parent link='a'/><child "
     "link='b'/></joint>"
     "\n<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
     "robot.urdf:3: the joints go round in a circle through link 'a'; a URDF has trees alone; remedy: remove one of "
     "them"},
    {"CircleBesideRoot",
     "<robot name='r'><link name='o'/><link name='a'/><joint name='j' type='fixed'><parent link='a'/><child "
     "link='a'/></joint></robot>",
     "the joints go round in a circle through link 'a'"},
    {"TwoParents",
     "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child "
     "link='b'/></joint>"
     "\n<joint name='k' type='fixed'><parent link='a'/><child link='b'/></joint></robot>",
     "robot.urdf:2: link 'b' is the child of two joints, 'j' and 'k'; a URDF has trees alone; remedy: remove one of "
     "them"},
    {"ShapeOutsideGeometry", "<robot name='r'><link name='a'><collision><box size='1 1 1'/></collision></link></robot>",
     "<collision> has no geometry"},
};

class LoadUrdfRefuses : public testing::TestWithParam<Case> {};

TEST_P(LoadUrdfRefuses, WithAMessage) {
    EXPECT_THAT(refusal(GetParam().text), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Text, LoadUrdfRefuses, testing::ValuesIn(cases),
                         [](const auto& refused) { return std::string(refused.param.name); });

TEST(LoadUrdfErrors, NumbersThatAreNone) {
    EXPECT_THAT(refusal_of_geometry("<sphere radius='-1'/>"),
                HasSubstr("robot.urdf:2: <sphere radius=\"-1\"> must be above 0"));
    EXPECT_THAT(refusal_of_geometry("<sphere/>"), HasSubstr("<sphere> has no radius"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='big'/>"), HasSubstr("'big' is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='nan'/>"), HasSubstr("'nan' is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='0,5'/>"), HasSubstr("'0,5' is not a finite number; remedy: 0.5"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='1e999'/>"), HasSubstr("'1e999' is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='  '/>"), HasSubstr("is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<cylinder radius='1' length='-2'/>"),
                HasSubstr("<cylinder length=\"-2\"> must be above 0"));
    EXPECT_THAT(refusal_of_geometry("<capsule radius='1' length='-1'/>"), HasSubstr("must be above 0"));
    EXPECT_THAT(refusal_of_geometry("<box size='1 -1 1'/>"), HasSubstr("<box size=\"1 -1 1\"> must be above 0"));
    EXPECT_THAT(refusal_of_geometry("<box size='1 1'/>"),
                HasSubstr("expects three numbers with blanks between them, got 2"));
    EXPECT_THAT(refusal_of_geometry("<box size='0,5 1 1'/>"), HasSubstr("'0,5' is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<box size='0,5 1,5 1'/>"),
                HasSubstr("'0,5' is not a finite number"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='1'/>", "<origin xyz='0 inf 0'/>"),
                HasSubstr("'inf' is not a finite"));
    EXPECT_THAT(refusal_of_geometry("<mesh filename='a.stl' scale='1 0 1'/>"), HasSubstr("no factor may be 0"));
}

TEST(LoadUrdfErrors, GeometryIsNeverDropped) {
    EXPECT_THAT(refusal_of_geometry("<ellipsoid/>"),
                HasSubstr("robot.urdf:2: unknown geometry <ellipsoid>; known: box, capsule, cylinder, mesh, sphere, "
                          "drake:ellipsoid, plane; remedy: one of these, or a mesh"));
    EXPECT_THAT(refusal_of_geometry("<sphere radius='1'/>", "<origin quat_xyzw='0 0 0 0'/>"),
                HasSubstr("is no quaternion of four numbers"));
}

TEST(LoadUrdfErrors, BrokenUtf16) {
    EXPECT_THAT(
        refusal(std::string("\xFF\xFE<\0r\0\0\xD8>\0", 10)),
        HasSubstr("/none/robot.urdf:1: is no valid UTF-16: half a character; remedy: get the file once more, not "
                  "through a text conversion"));
}

TEST(LoadUrdfErrors, DeepNestingIsRefusedNotFatal) {
    std::string text = "<robot name='r'>";
    for (int i = 0; i < 100'000; ++i) {
        text += "<a>";
    }
    EXPECT_THAT(refusal(text), HasSubstr("nested more than 200 deep"));
}

} // namespace
} // namespace foam::test
