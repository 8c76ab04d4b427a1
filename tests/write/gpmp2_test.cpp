// write.gpmp2, and how read.rows gives its files back.
#include "plugin_stages.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

#include <numbers>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

const Format gpmp2{"read_rows", "write.gpmp2", "read.rows"};

SphereModel arm() {
    SphereModel model = model_of(chain_of({"base", "tool"}),
                                 {group_of("base", {}, flat_tree({{{0.25, 0.5, 0.125}, 0.5}})),
                                  group_of("tool", {}, flat_tree({{{0, 0, 0.75}, 0.25}, {{1, 2, 4}, 0.5}}))});
    model.provenance = "foam 1; part.urdf; proved";
    return model;
}

std::string refusal_of(const SphereModel& model, const std::string& frames) {
    return refusal(*writer("read_rows", "write.gpmp2", {{"frames", frames}}), model);
}

std::string wrong_frames(const std::string& frames) {
    try {
        writer("read_rows", "write.gpmp2", {{"frames", frames}});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
    return "";
}

TEST(WriteGpmp2, WritesCentersInTheFramesOfTheDhLinks) {
    // The tool's frame is a quarter turn about x and 1 m along y away: its z is the DH link's -y.
    const std::string frames = "base 0 0 0 0.5 0 0 0\n tool 3 0 1 0 1.5707963267948966 0 0;";
    const std::string text = gpmp2.text(arm(), {{"frames", frames}});
    EXPECT_EQ(text, "% foam 1; part.urdf; proved\n% link_id x y z r, in the frames of the DH links\n"
                    "% foam frame: base 0 0 0 0.5 0 0 0\n0 0.25 0.5 0.625 0.5\n"
                    "% foam frame: tool 3 0 1 0 1.5707963267948966 0 0\n3 0 0.25 0 0.25\n3 1 -3 2 0.5\n");
    EXPECT_EQ(read_spheres(*writer("read_rows", "write.gpmp2"), text), spheres_of(arm()));
    const SphereFile file = gpmp2.file(text);
    EXPECT_EQ(file.format, "GPMP2 rows");
    EXPECT_EQ(file.links.at(1).link, "tool");
    EXPECT_TRUE(file.notes.empty());
    EXPECT_TRUE(gpmp2.reader()->recognises(text));
}

TEST(WriteGpmp2, TheCenterOfGpmp2IsThatOfTheUrdf) {
    // A planar arm by Denavit and Hartenberg: a = 0.4 m, so that the frame after link 0 is at the end of the link.
    const double turn = 0.7, a = 0.4;
    const Pose urdf_link = Pose::from_axis_angle({0, 0, 1}, turn);
    Pose along;
    along.translation = {a, 0, 0};
    const Pose dh_link = urdf_link * along;
    const SphereFile read = gpmp2.file("0 -0.15 0 0 0.1\n");
    EXPECT_EQ(read.links.at(0).link, "0");
    EXPECT_EQ(read.notes, std::vector<std::string>{"links are numbers: centers of GPMP2 are in the frames of DH links, "
                                                   "which the file does not state; they are taken as they stand"});
    const SphereModel model = model_of(nullptr, {group_of("link", {}, flat_tree({{{0.25, 0, 0}, 0.1}}))});
    const SphereFile rows = gpmp2.file(gpmp2.text(model, {{"frames", "link 0 -0.4 0 0 0 0 0"}}));
    EXPECT_LT(
        distance(urdf_link * rows.links.at(0).elements.spheres().at(0).center, dh_link * read.links.at(0).elements.spheres().at(0).center),
        1e-15);
}

TEST(WriteGpmp2, SpheresContainThoseOfTheModelWhateverTheRounding) {
    const SphereModel model = model_of(
        nullptr,
        {group_of(
            "l", {},
            flat_tree({{{0.1, -0.2, 1.0 / 3}, 0.05}, {{123456.789, 1e3, -7.1}, 1e-3}, {{1e-17, 1234.5, -0.0}, 0.8}}))});
    const auto read =
        read_spheres(*writer("read_rows", "write.gpmp2"), gpmp2.text(model, {{"frames", "l 2 0.1 0.2 0.3 0.4 0.5 0.6"}}));
    const std::vector<Sphere>& before = model.groups[0].tree.finest();
    ASSERT_EQ(read.at("l").size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Sphere& after = read.at("l")[i];
        EXPECT_GE(after.radius, before[i].radius + distance(after.center, before[i].center));
        EXPECT_LT(after.radius, before[i].radius + 1e-10);
    }
}

TEST(WriteGpmp2, RefusesWhatItCannotKnow) {
    EXPECT_EQ(refusal_of(arm(), ""),
              "write.gpmp2 needs the frames of the DH links, which a URDF does not state; remedy: in the recipe, "
              "write.gpmp2: {frames: \"LINK ID x y z roll pitch yaw; …\"}, for each link with spheres its pose in the "
              "frame of DH link ID");
    EXPECT_EQ(refusal_of(arm(), "base 0 0 0 0 0 0 0; tol 1 0 0 0 0 0 0"),
              "write.gpmp2: link 'tool' has spheres, but 'frames' does not name it; did you mean 'tol'?; remedy: add "
              "'tool ID x y z roll pitch yaw', its pose in the frame of DH link ID, or leave the link out");
    EXPECT_EQ(wrong_frames("base 0 0 0"),
              "write.gpmp2: frames: 'base 0 0 0': 4 words; expected is LINK ID x y z roll pitch yaw");
    EXPECT_THAT(wrong_frames("base 1.5 0 0 0 0 0 0"), HasSubstr("1.5 is not the number of a link, 0 or more"));
    EXPECT_THAT(wrong_frames("base -1 0 0 0 0 0 0"), HasSubstr("-1 is not the number of a link, 0 or more"));
    EXPECT_THAT(wrong_frames("base 1 0 0 0 0 0 pi"), HasSubstr("'pi' is not a finite number"));
    EXPECT_THAT(wrong_frames("a 1 0 0 0 0 0 0; b 1 0 0 0 0 0 0; a 2 0 0 0 0 0 0"),
                HasSubstr("link 'a' is given twice; remedy: delete one"));
}

TEST(WriteGpmp2, FramesSoFarAwayThatDigitsAreLost) {
    EXPECT_EQ(
        refusal_of(arm(), "base 0 1e17 0 0 0 0 0; tool 1 0 0 0 0 0 0"),
        "write.gpmp2: the frame of link 'base' is so far away that a center of it moves by 0.25 m in rounding; remedy: "
        "correct 'base 0 1e17 0 0 0 0 0'");
    EXPECT_THAT(refusal_of(arm(), "base 0 1e308 0 0 1 1 1; tool 1 0 0 0 0 0 0"), HasSubstr("so far away"));
    EXPECT_EQ(gpmp2.message("% foam frame: l 0 1e308 1e308 1e308 0.5 0.5 0.5\n0 -1e308 -1e308 -1e308 1\n"),
              "FILE:2: the center is no finite point in the frame of 'l'; remedy: correct the frame or the row");
}

TEST(WriteGpmp2, ReadsWhatIsLeftOfItsFiles) {
    const std::string text = gpmp2.text(arm(), {{"frames", "base 0 0 0 0 0 0 0; tool 1 0 0 0 0 0 0"}});
    gpmp2.expect_truncations(text);
    EXPECT_EQ(gpmp2.message("% foam frame: base 0 0 0\n0 0 0 0 1\n"),
              "FILE:1: the frame 'base 0 0 0': 4 words; expected is LINK ID x y z roll pitch yaw");
    EXPECT_EQ(
        gpmp2.message("% foam frame: base 0 0 0 0 0 0 0\n1 0 0 0 1\n"),
        "FILE:2: a row of link 1 below the frame of 'base' on link 0; remedy: write the file again with write.gpmp2");
    EXPECT_EQ(
        gpmp2.message("% foam frame: base 0 0 0 0 0 0 0\n0 0 0 1\n"),
        "FILE:2: a row of link without number below the frame of 'base' on link 0; remedy: write the file again with "
        "write.gpmp2");
}

} // namespace
} // namespace foam::test
