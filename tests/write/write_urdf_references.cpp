// write.urdf lets relative paths of meshes lead to their files from the new file's folder.
#include "models.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Keeps what a writer says.
class Listening final : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        said.push_back((severity == Severity::warning ? "warning: " : "note: ") + std::string(message));
    }
    std::vector<std::string> said;
};

class WriteUrdfReferences : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* file : {"in/meshes/a.dae", "in/meshes/b.stl", "in/wood & \"oak\".png", "other/c.obj"}) {
            fs::create_directories((root_ / file).parent_path());
            std::ofstream(root_ / file) << "x";
        }
        fs::create_directories(root_ / "out");
    }

    /// The text with link "a" made of a sphere, as it is to lie in `folder`.
    std::string written(const std::string& text, const fs::path& folder, const std::string& mesh_paths = "rewrite") {
        Robot robot;
        robot.file = root_ / "in/robot.urdf";
        robot.source = text;
        SphereModel model = model_of(std::make_shared<const Robot>(robot), {group_of("a", {}, flat_tree({{{}, 1}}))});
        model.folder = folder;
        context_.said.clear();
        return writer("write_urdf", "write.urdf", {{"mesh_paths", mesh_paths}})->write(model, context_);
    }

    static std::string visual(const std::string& attribute) {
        return "<robot><link name='a'><visual><geometry><mesh " + attribute + "/></geometry></visual><collision>" +
               R"(<origin xyz="0 0 0" rpy="0 0 0"/><geometry><sphere radius="1"/></geometry></collision></link></robot>)";
    }

    TemporaryFolder folder_;
    fs::path root_ = fs::canonical(folder_.path());
    Listening context_;
};

TEST_F(WriteUrdfReferences, LeadFromTheNewFolder) {
    EXPECT_EQ(written(visual("scale='1 1 1' filename='meshes/a.dae'"), root_ / "out"),
              visual("scale='1 1 1' filename='../in/meshes/a.dae'"));
    EXPECT_THAT(context_.said, ElementsAre("note: 1 relative paths of meshes are rewritten so that they lead to their "
                                           "files (the first: 'meshes/a.dae')"));
    EXPECT_EQ(written(visual("filename = \"./../other/c.obj\" scale=\"1 1 1\""), root_ / "not/there/yet"),
              visual("filename = \"../../../other/c.obj\" scale=\"1 1 1\""));
    EXPECT_EQ(written(visual("filename='meshes/a.dae'"), root_), visual("filename='in/meshes/a.dae'"));
}

TEST_F(WriteUrdfReferences, KeepTheirBytesWhereTheyAreRight) {
    const std::string text = visual("filename='./meshes//a.dae'");
    EXPECT_EQ(written(text, root_ / "in"), text);
    EXPECT_EQ(written(text, root_ / "out/../in"), text);
    fs::create_directory_symlink(root_ / "in", root_ / "alias");
    EXPECT_EQ(written(text, root_ / "alias"), text);
    fs::create_directory_symlink(root_ / "in/meshes", root_ / "out/meshes");
    EXPECT_EQ(written(text, root_ / "out"), text) << "the same file under the same name";
    EXPECT_THAT(context_.said, ElementsAre());
    for (const char* kept : {"package://p/a.dae", "file:///a.dae", "/a.dae", "model://m/a.dae", ""}) {
        EXPECT_EQ(written(visual("filename='" + std::string(kept) + "'"), root_ / "out"),
                  visual("filename='" + std::string(kept) + "'"));
    }
    EXPECT_THAT(context_.said, ElementsAre());
}

TEST_F(WriteUrdfReferences, AcrossASymbolicLink) {
    fs::create_directories(root_ / "deep/er");
    fs::create_directory_symlink(root_ / "deep/er", root_ / "short");
    EXPECT_EQ(written(visual("filename='meshes/a.dae'"), root_ / "short"), visual("filename='../../in/meshes/a.dae'"))
        << "'..' of a link is that of where it leads";
}

TEST_F(WriteUrdfReferences, ThatLeadNowhereStay) {
    const std::string text = visual("filename='meshes/none.dae'");
    EXPECT_EQ(written(text, root_ / "out"), text);
    EXPECT_THAT(context_.said, ElementsAre("warning: 1 relative paths of meshes lead to no file from the folder of " +
                                           (root_ / "in/robot.urdf").string() +
                                           " and are kept as they are (the first: "
                                           "'meshes/none.dae')"));
}

TEST_F(WriteUrdfReferences, AllOfThemButReplacedCollisions) {
    const std::string text =
        "<robot><material name='m'><texture filename='wood &amp; \"oak\".png'/></material>"
        "<link name='a'><visual><geometry><mesh "
        "filename='meshes/a.dae'/></geometry></visual><collision><geometry><mesh "
        "filename='meshes/b.stl'/></geometry></collision></link><!-- filename='meshes/a.dae' -->"
        "<link name='b'><collision><geometry><mesh filename='meshes/b.stl'/></geometry></collision></link>"
        "<gazebo><plugin filename='meshes/b.stl'/></gazebo></robot>";
    EXPECT_EQ(written(text, root_ / "out"),
              "<robot><material name='m'><texture filename='../in/wood &#38; &#34;oak&#34;.png'/></material>"
              "<link name='a'><visual><geometry><mesh filename='../in/meshes/a.dae'/></geometry></visual><collision>"
              "<origin xyz=\"0 0 0\" rpy=\"0 0 0\"/><geometry><sphere radius=\"1\"/></geometry></collision></link>"
              "<!-- filename='meshes/a.dae' -->"
              "<link name='b'><collision><geometry><mesh filename='../in/meshes/b.stl'/></geometry></collision></link>"
              "<gazebo><plugin filename='meshes/b.stl'/></gazebo></robot>");
}

TEST_F(WriteUrdfReferences, InOtherEncodings) {
    fs::create_directories(root_ / "in/\xC3\xA9");
    std::ofstream(root_ / "in/\xC3\xA9/a.dae") << "x";
    const std::string latin = "<?xml version='1.0' encoding='ISO-8859-1'?>";
    EXPECT_EQ(written(latin + visual("filename='\xE9/a.dae'"), root_ / "out"),
              latin + visual("filename='../in/&#233;/a.dae'"));
    EXPECT_EQ(written(visual("filename='\xC3\xA9/a.dae'"), root_ / "out"), visual("filename='../in/\xC3\xA9/a.dae'"));
}

TEST_F(WriteUrdfReferences, AsTheParameterSays) {
    const std::string text = visual("filename='meshes/a.dae'");
    EXPECT_EQ(written(text, root_ / "out", "keep"), text);
    EXPECT_THAT(context_.said, ElementsAre(HasSubstr("note: relative paths of meshes are kept as they are")));
    EXPECT_EQ(written(text, root_ / "out", "absolute"),
              visual("filename='" + (root_ / "in/meshes/a.dae").string() + "'"));
    EXPECT_EQ(written(text, {}, "absolute"), written(text, root_ / "out", "absolute"));
    EXPECT_EQ(written(text, {}), text) << "nobody knows where it will lie";
    EXPECT_THAT(context_.said,
                ElementsAre(HasSubstr("warning: relative paths of meshes are kept as they are (the first: "
                                      "'meshes/a.dae'); they lead to their files from the folder of ")));
}

} // namespace
} // namespace foam::test
