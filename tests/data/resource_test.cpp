// Where references lead.
#include <foam/sdk/resource.hpp>

#include <support/temporary_folder.hpp>

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

namespace foam {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class Resources : public testing::Test {
protected:
    fs::path root() const { return folder.path(); }
    fs::path file(const std::string& name, const std::string& text = "") {
        fs::create_directories((root() / name).parent_path());
        std::ofstream(root() / name) << text;
        return root() / name;
    }
    fs::path found(const std::string& reference, const fs::path& base, std::vector<fs::path> package_path = {}) {
        return ResourceResolver(std::move(package_path)).resolve(reference, base).path;
    }
    TemporaryFolder folder;
};

TEST_F(Resources, RelativeAndAbsolutePaths) {
    const fs::path mesh = file("urdf/meshes/a.stl");
    EXPECT_EQ(found("meshes/a.stl", root() / "urdf"), mesh);
    EXPECT_EQ(found("./meshes//a.stl", root() / "urdf"), mesh);
    EXPECT_TRUE(fs::equivalent(found("../urdf/meshes/a.stl", root() / "urdf"), mesh));
    EXPECT_EQ(found(mesh.string(), "/elsewhere"), mesh);
    EXPECT_EQ(found("b.stl", root() / "urdf"), "");
    EXPECT_EQ(found("", root()), "");
    EXPECT_EQ(found("meshes", root() / "urdf"), "") << "a folder is no file";
}

TEST_F(Resources, FileUris) {
    const fs::path mesh = file("a b/c.stl");
    EXPECT_EQ(found("file://" + mesh.string(), "/elsewhere"), mesh);
    EXPECT_EQ(found("file://" + (root() / "a%20b/c.stl").string(), "/elsewhere"), mesh);
    EXPECT_EQ(found("file://localhost" + mesh.string(), "/elsewhere"), mesh);
    EXPECT_EQ(found("file://a b/c.stl", root()), mesh) << "two slashes and a relative path, as people write it";
}

TEST_F(Resources, PercentEscapes) {
    const fs::path space = file("pkg/a b.stl"), literal = file("pkg/100%25.stl"), sign = file("pkg/50%.stl");
    EXPECT_EQ(found("package://pkg/a%20b.stl", root()), space);
    EXPECT_EQ(found("package://pkg/a b.stl", root()), space);
    EXPECT_EQ(found("package://pkg/100%25.stl", root()), literal) << "the escape stands in the name itself";
    EXPECT_EQ(found("package://pkg/50%.stl", root()), sign) << "a lone % is no escape";
    EXPECT_EQ(found("package://pkg/50%25.stl", root()), sign);
    EXPECT_EQ(found("package://pkg/a%00b.stl", root()), "");
    EXPECT_EQ(found("pkg/a%20b.stl", root()), space);
}

TEST_F(Resources, PackagePathComesBeforeAncestors) {
    const fs::path near = file("ws/pkg/meshes/a.stl"), far = file("other/pkg/meshes/a.stl");
    EXPECT_EQ(found("package://pkg/meshes/a.stl", root() / "ws/pkg/urdf"), near);
    EXPECT_EQ(found("package://pkg/meshes/a.stl", root() / "ws/pkg/urdf", {root() / "other"}), far);
    EXPECT_EQ(found("package://pkg/meshes/a.stl", root() / "ws/pkg/urdf", {root() / "other/pkg/"}), far)
        << "is the package";
    EXPECT_EQ(found("model://pkg/meshes/a.stl", root() / "ws/pkg/urdf"), near);
    EXPECT_EQ(found("package://pkg//meshes/a.stl", root() / "ws"), near);
    EXPECT_EQ(found("package://pkg", root() / "ws"), "");
    EXPECT_EQ(found("package:///meshes/a.stl", root() / "ws/pkg"), "");
}

TEST_F(Resources, PackageXmlNamesAPackage) {
    const fs::path mesh = file("checkout-main/meshes/a.stl");
    file("checkout-main/package.xml",
         "<?xml version='1.0'?><!-- <name>wrong</name> --><package><name> arm </name></package>");
    EXPECT_EQ(found("package://arm/meshes/a.stl", "/elsewhere", {root() / "checkout-main"}), mesh);
    EXPECT_EQ(found("package://arm/meshes/a.stl", root() / "checkout-main/urdf"), mesh);
    EXPECT_EQ(found("package://arm/meshes/a.stl", "/elsewhere", {root()}), mesh);
    EXPECT_EQ(found("package://wrong/meshes/a.stl", root() / "checkout-main"), "");
}

TEST_F(Resources, WorkspacesAreSearchedTwoLevelsDeep) {
    const fs::path mesh = file("src/repository/pkg/a.stl");
    file("src/.git/pkg/b.stl");
    file("src/1/2/3/deep/c.stl");
    EXPECT_EQ(found("package://pkg/a.stl", "/elsewhere", {root() / "src"}), mesh);
    EXPECT_EQ(found("package://pkg/b.stl", "/elsewhere", {root() / "src"}), "");
    EXPECT_EQ(found("package://deep/c.stl", "/elsewhere", {root() / "src"}), "");
}

TEST_F(Resources, SymbolicLinks) {
    const fs::path mesh = file("real/pkg/meshes/a.stl");
    fs::create_directories(root() / "real/pkg/urdf");
    fs::create_directory_symlink(root() / "real/pkg/urdf", root() / "link");
    EXPECT_TRUE(fs::equivalent(found("../meshes/a.stl", root() / "link"), mesh)) << "'..' is the file system's";
    EXPECT_TRUE(fs::equivalent(found("package://pkg/meshes/a.stl", root() / "link"), mesh));
    fs::create_directory_symlink(root() / "loop", root() / "loop");
    EXPECT_EQ(found("loop/a.stl", root()), "");
    EXPECT_EQ(found("package://loop/a.stl", root() / "loop", {root() / "loop"}), "");
}

TEST_F(Resources, DotsMayLeaveThePackage) {
    fs::create_directories(root() / "pkg");
    const fs::path mesh = file("common/a.stl");
    EXPECT_TRUE(fs::equivalent(found("package://pkg/../common/a.stl", root()), mesh));
}

TEST_F(Resources, SaysWhereItLooked) {
    const ResolvedResource resource =
        ResourceResolver({root() / "path"}).resolve("package://pkg/a.stl", root() / "base");
    EXPECT_FALSE(resource.found());
    ASSERT_GE(resource.tried.size(), 3u);
    EXPECT_EQ(resource.tried[0], root() / "path/pkg/a.stl");
    EXPECT_EQ(resource.tried[1], root() / "base/pkg/a.stl");
    EXPECT_EQ(resource.tried[2], root() / "pkg/a.stl");
    EXPECT_TRUE(ResourceResolver().resolve("https://example.org/a.stl", root()).tried.empty());
}

TEST_F(Resources, EnvironmentInItsOrder) {
    setenv("FOAM_PACKAGE_PATH", (root() / "foam").c_str(), 1);
    const std::string with_empty_entries = (root() / "ros").string() + "::";
    setenv("ROS_PACKAGE_PATH", with_empty_entries.c_str(), 1);
    setenv("AMENT_PREFIX_PATH", (root() / "ament").c_str(), 1);
    const ResolvedResource resource = ResourceResolver::from_environment().resolve("package://pkg/a.stl", "/elsewhere");
    unsetenv("FOAM_PACKAGE_PATH");
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
    const fs::path foam = root() / "foam", ros = root() / "ros", share = root() / "ament/share", rest = "pkg/a.stl";
    EXPECT_THAT(resource.tried,
                ElementsAre(foam / rest, ros / rest, share / rest, fs::path("/elsewhere") / rest, fs::path("/") / rest,
                            foam / "*" / rest, foam / "*/*" / rest, ros / "*" / rest, ros / "*/*" / rest,
                            share / "*" / rest, share / "*/*" / rest));
}

} // namespace
} // namespace foam
