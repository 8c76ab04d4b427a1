// foam gallery as a user runs it.
#include "cli/program.hpp"

#include "arm.hpp"

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class GalleryCli : public Cli {
protected:
    GalleryCli() { write("arm.urdf", arm_urdf); }

    /// Returns the width and height of a PNG.
    std::pair<unsigned, unsigned> size_of(const std::string& file) const {
        const std::string png = contents(path() / file);
        EXPECT_THAT(png, StartsWith("\x89PNG\r\n"));
        const auto number = [&](std::size_t at) {
            unsigned value = 0;
            for (std::size_t i = 0; i < 4 && at + i < png.size(); ++i) {
                value = 256 * value + static_cast<unsigned char>(png[at + i]);
            }
            return value;
        };
        return {number(16), number(20)};
    }
};

TEST_F(GalleryCli, DrawsTheRobotAndAViewForEachCount) {
    const Outcome drawn = foam("gallery arm.urdf 12 4");
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_THAT(drawn.err, AllOf(HasSubstr("4 spheres of at most 4"), HasSubstr("written: arm_gallery.png")));
    const auto [width, height] = size_of("arm_gallery.png");
    EXPECT_EQ(width % 440, 0u);
    EXPECT_EQ(height, 640u);
    EXPECT_EQ(foam("gallery arm.urdf 4 -o small.png --size 500x300").code, 0);
    EXPECT_EQ(size_of("small.png"), (std::pair{500u, 300u}));
}

TEST_F(GalleryCli, TurnsTheSame) {
    const std::string size = " -o p.png --size 120x100 --frames 3 --turntable ";
    const Outcome turned = foam("gallery arm.urdf 4" + size + "a.webp");
    EXPECT_EQ(turned.code, 0) << turned.err;
    const std::string webp = contents(path() / "a.webp");
    EXPECT_THAT(webp, StartsWith("RIFF"));
    EXPECT_THAT(webp, AllOf(HasSubstr("WEBP"), HasSubstr("ANIM")));
    std::size_t frames = 0;
    for (std::size_t at = webp.find("ANMF"); at != webp.npos; at = webp.find("ANMF", at + 4)) {
        ++frames;
    }
    EXPECT_EQ(frames, 3u);
    EXPECT_EQ(foam("gallery arm.urdf 4" + size + "b.webp").code, 0);
    EXPECT_EQ(contents(path() / "b.webp"), webp);
}

TEST_F(GalleryCli, SaysWhatIsWrong) {
    EXPECT_THAT(foam("gallery arm.urdf").err, HasSubstr("counts is required"));
    EXPECT_THAT(foam("gallery none.urdf 4").err, HasSubstr("none.urdf"));
    EXPECT_THAT(foam("gallery arm.urdf 4 --size 12").err, HasSubstr("--size expects pixels such as 1600x600"));
    EXPECT_THAT(foam("gallery arm.urdf 4 --pose sit").err,
                HasSubstr("there is no pose 'sit'; remedy: --pose with one of: zero"));
    const Outcome refused = foam("gallery arm.urdf 4 -o arm.urdf");
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(contents(path() / "arm.urdf"), arm_urdf);
    EXPECT_FALSE(std::filesystem::exists(path() / "arm_gallery.png"));
}

} // namespace
} // namespace foam::test
