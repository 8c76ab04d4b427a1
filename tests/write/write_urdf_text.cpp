// write.urdf changes nothing but collision geometry: oddly formatted texts.
#include "models.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using testing::HasSubstr;

const std::string one =
    R"(<collision><origin xyz="1 2 3" rpy="0 0 0"/><geometry><sphere radius="0.5"/></geometry></collision>)";
const std::string two =
    R"(<collision><origin xyz="-1 0 0.1" rpy="0 0 0"/><geometry><sphere radius="0.25"/></geometry></collision>)";

/// The text with link "a" made of the spheres `one` and `two`.
std::string written(const std::string& source, const std::map<std::string, ParameterValue>& parameters = {}) {
    Robot robot;
    robot.file = "/none/robot.urdf";
    robot.source = source;
    QuietContext context;
    const SphereModel model = model_of(std::make_shared<const Robot>(robot),
                                       {group_of("a", {"box"}, flat_tree({{{1, 2, 3}, 0.5}, {{-1, 0, 0.1}, 0.25}}))});
    return writer("write_urdf", "write.urdf", parameters)->write(model, context);
}

TEST(WriteUrdf, PutsOneSphereALineInThePlaceOfTheFirstElement) {
    EXPECT_EQ(
        written("<robot>\n\t<link name='a'>\n\t\t<visual/>\n\t\t<collision>\n\t\t\t<geometry/>\n\t\t</collision>\n"
                "\t\t<collision/>\n\t\t<inertial/>\n\t</link>\n</robot>\n"),
        "<robot>\n\t<link name='a'>\n\t\t<visual/>\n\t\t" + one + "\n\t\t" + two +
            "\n\t\t<inertial/>\n\t</link>\n</robot>\n");
}

TEST(WriteUrdf, KeepsWindowsLineEndsByteOrderMarkAndDeclaration) {
    EXPECT_EQ(written("\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<robot name=\"\xC3\xA9\">\r\n<link "
                      "name=\"a\">\r\n"
                      "  <collision/>\r\n</link>\r\n</robot>"),
              "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<robot name=\"\xC3\xA9\">\r\n<link "
              "name=\"a\">\r\n  " +
                  one + "\r\n  " + two + "\r\n</link>\r\n</robot>");
}

TEST(WriteUrdf, KeepsOtherEncodings) {
    EXPECT_EQ(
        written(
            "<?xml version='1.0' encoding='ISO-8859-1'?><robot name='\xE9'><link name='a'><collision/></link></robot>"),
        "<?xml version='1.0' encoding='ISO-8859-1'?><robot name='\xE9'><link name='a'>" + one + two +
            "</link></robot>");
}

TEST(WriteUrdf, IsNotConfusedByTextThatLooksLikeElements) {
    const std::string before =
        "<robot a='>' b=\"/>\"><!-- <collision> --><![CDATA[<link name='a'><collision/>]]>"
        "<x:link name='a' xmlns:x='u'><collision/></x:link><gazebo reference='a'><collision/></gazebo>"
        "<link note='<![CDATA[' name = 'a' ><!-- </link> --><sensor><collision name='s'/></sensor>";
    const std::string after = "<!-- kept --><?pi <collision/> ?></link ></robot>";
    // "<" in an attribute is an error of XML, so the note holds an escape.
    const auto legal = [](std::string text) { return text.replace(text.find("'<![CDATA['"), 11, "'&lt;![CDATA['"); };
    EXPECT_EQ(written(legal(before) + "<collision a='>'>a<!-- gone --></collision >" + "<collision\n/>" + after),
              legal(before) + one + two + after);
}

TEST(WriteUrdf, KeepsCommentsBetweenElements) {
    EXPECT_EQ(written("<robot><link name='a'>\n  <!-- 1 -->\n  <collision/> <!-- 2 -->\n  <!-- 3 -->\n  <collision/> "
                      "<!-- 4 -->\n</link></robot>"),
              "<robot><link name='a'>\n  <!-- 1 -->\n  " + one + "\n  " + two +
                  " <!-- 2 -->\n  <!-- 3 --> <!-- 4 -->\n</link></robot>");
}

TEST(WriteUrdf, LeavesOtherLinksAlone) {
    const std::string other =
        "<link name='b'><collision><geometry><mesh filename='m.stl'/></geometry></collision></link>";
    EXPECT_EQ(written("<robot>" + other + "<link name='a'><collision/></link>" + other + "</robot>").find(other), 7u);
}

TEST(WriteUrdf, GivesSpheresToLinksWithoutCollision) {
    EXPECT_EQ(written("<robot>\n  <link name='a' />\n</robot>"),
              "<robot>\n  <link name='a' >\n    " + one + "\n    " + two + "\n  </link>\n</robot>");
    EXPECT_EQ(written("<robot>\n  <link name='a'>\n    <visual/>\n  </link>\n</robot>"),
              "<robot>\n  <link name='a'>\n    <visual/>\n    " + one + "\n    " + two + "\n  </link>\n</robot>");
    EXPECT_EQ(written("<robot><link name='a'/></robot>"), "<robot><link name='a'>" + one + two + "</link></robot>");
}

TEST(WriteUrdf, WritesTheLevelThatIsAskedFor) {
    const std::string coarse =
        written("<robot><link name='a'><collision/></link></robot>", {{"level", std::int64_t{0}}});
    EXPECT_EQ(coarse.find("<sphere"), coarse.rfind("<sphere"));
    EXPECT_EQ(written("<robot><link name='a'/></robot>", {{"level", std::int64_t{7}}}),
              written("<robot><link name='a'/></robot>"));
}

TEST(WriteUrdf, ReadsSpheresAsOthersWriteThem) {
    const auto spheres = read_spheres(*writer("write_urdf", "write.urdf"), R"(<robot><link name="a">
        <collision><geometry><sphere radius="1"/></geometry></collision>
        <collision><origin rpy="1 2 3"/><geometry><sphere radius="2"/></geometry></collision>
        <collision><origin xyz="  1   2
            3 "/><geometry><sphere radius=" +0.5 "/></geometry></collision>
        <collision><geometry><box size="1 1 1"/></geometry></collision></link><link name="b"/></robot>)");
    EXPECT_EQ(spheres,
              (std::map<std::string, std::vector<Sphere>>{{"a", {{{0, 0, 0}, 1}, {{0, 0, 0}, 2}, {{1, 2, 3}, 0.5}}}}));
}

TEST(WriteUrdf, SaysThatRelativeMeshPathsAreKept) {
    class Listener final : public QuietContext {
    public:
        void log(Severity, std::string_view message) override { messages.emplace_back(message); }
        std::vector<std::string> messages;
    } context;
    auto robot = std::make_shared<Robot>();
    robot->file = "/none/robot.urdf";
    robot->source =
        "<robot><link name='a'><visual><geometry><mesh filename='package://p/v.dae'/></geometry></visual>"
        "<collision><geometry><mesh filename='gone.stl'/></geometry></collision></link>"
        "<link name='b'><collision><geometry><mesh filename='kept.stl'/></geometry></collision></link></robot>";
    const SphereModel model = model_of(robot, {group_of("a", {}, flat_tree(awkward_spheres()))});
    writer("write_urdf", "write.urdf")->write(model, context);
    EXPECT_THAT(context.messages, testing::ElementsAre(HasSubstr("the first: 'kept.stl'")));
}

TEST(WriteUrdf, SaysWhatStandsInTheWay) {
    EXPECT_THROW(written("<robot><link name='b'/></robot>"), Error);
    EXPECT_THROW(written(""), Error);
    const auto urdf = writer("write_urdf", "write.urdf");
    SphereModel model = awkward_model();
    model.groups[0].link = "gone";
    EXPECT_THAT(refusal(*urdf, model), HasSubstr("the URDF text has no link 'gone'"));
    model.robot = nullptr;
    EXPECT_THAT(refusal(*urdf, model), HasSubstr("no URDF text"));
}

} // namespace
} // namespace foam::test
