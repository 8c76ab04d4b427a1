// write.csv and write.ply.
#include "models.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

SphereModel two_spheres() {
    return model_of(chain_of({"a", "b, c"}), {group_of("a", {}, flat_tree({{{1, 2, 3}, 0.5}})),
                                              group_of("b, c", {}, flat_tree({{{0, 0, 0.1}, 1}}))});
}

TEST(WriteCsv, WritesARowASphere) {
    QuietContext context;
    EXPECT_EQ(writer("write_csv", "write.csv")->write(two_spheres(), context),
              "link,x,y,z,radius\na,1,2,3,0.5\n\"b, c\",0,0,0.1,1\n");
}

TEST(WriteCsv, ReadsWhatSpreadsheetsWrite) {
    const auto spheres =
        read_spheres(*writer("write_csv", "write.csv"), "link,x,y,z,radius\r\n\"say \"\"a\"\"\",1,2,3,0.5\r\nb,0,0,0,1");
    EXPECT_EQ(spheres,
              (std::map<std::string, std::vector<Sphere>>{{"b", {{{0, 0, 0}, 1}}}, {"say \"a\"", {{{1, 2, 3}, 0.5}}}}));
}

TEST(WriteCsv, RefusesOtherTables) {
    const auto csv = writer("write_csv", "write.csv");
    for (const char* text : {"x,y,z\n", "link,x,y,z,radius\na,1,2,3\n", "link,x,y,z,radius\na,1,2,3,big\n",
                             "link,x,y,z,radius\n\"a,1,2,3,1\n", "link,x,y,z,radius\n\"a\"b,1,2,3,1\n"}) {
        EXPECT_THROW(read_spheres(*csv, text), Error) << text;
    }
}

TEST(WritePly, WritesAVertexASphere) {
    QuietContext context;
    EXPECT_EQ(writer("write_ply", "write.ply")->write(two_spheres(), context),
              "ply\nformat ascii 1.0\ncomment spheres in link frames, metres\ncomment link 0 a\ncomment link 1 b, c\n"
              "element vertex 2\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\n"
              "property int link\nend_header\n1 2 3 0.5 0\n0 0 0.1 1 1\n");
}

TEST(WritePly, SurfacesStandInTheRobotsZeroPose) {
    QuietContext context;
    const auto ply = writer("write_ply", "write.ply", {{"form", "surface"}, {"subdivisions", std::int64_t{0}}});
    const std::string text = ply->write(two_spheres(), context);
    EXPECT_THAT(text, testing::HasSubstr("element vertex 24\n"));
    EXPECT_THAT(text, testing::HasSubstr("element face 40\n"));
    EXPECT_THAT(text, testing::HasSubstr("element sphere 2\n"));
    // The last of 24 vertices lies on the sphere of the second link, whose frame is at z = 1.
    std::istringstream rows(text.substr(text.find("end_header\n") + 11));
    Vec3 p;
    for (int i = 0; i < 24; ++i) {
        rows >> p.x >> p.y >> p.z;
    }
    EXPECT_NEAR(distance(p, {0, 0, 1.1}), 1, 1e-15);
    EXPECT_EQ(read_spheres(*ply, text), spheres_of(two_spheres()));
}

TEST(WritePly, NamesMayHoldAnything) {
    QuietContext context;
    const auto ply = writer("write_ply", "write.ply");
    const SphereModel model = model_of(nullptr, {group_of("a\n100%41 b", {}, flat_tree({{{1, 2, 3}, 1}}))});
    EXPECT_EQ(read_spheres(*ply, ply->write(model, context)), spheres_of(model));
}

} // namespace
} // namespace foam::test
