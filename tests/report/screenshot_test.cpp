// The report as it looks: light, dark, and on a phone.
#include "browser.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace foam::test {
namespace {

constexpr const char* chain = "stages: [repair.auto, spherize.octree]\nbudget: {spheres: 9}\n";

class Screenshot : public InBrowser {
protected:
    /// Empty if the browser does not start here. `clicks`: on the button that goes from the system's theme to light and
    /// dark.
    cv::Mat3b shot(int clicks, int width, int height) {
        report_of(recipe(chain));
        let_in("for (let i = 0; i < " + std::to_string(clicks) +
               "; ++i) document.querySelector('button.theme').click();"
               "setTimeout(() => { if (document.getElementById('viewer').dataset.error) document.body.style.border = "
               "'10px solid rgb(255, 0, 0)'; }, 1000);");
        const std::string size = std::to_string(width) + "," + std::to_string(height);
        if (!browse(std::string(software_gl) + " --hide-scrollbars --screenshot=shot.png --window-size=" + size,
                    "said.txt")) {
            return {};
        }
        return cv::imread((folder.path() / "shot.png").string());
    }

    /// Share of the picture's pixels.
    template <class Condition> static double share(const cv::Mat3b& picture, Condition&& condition) {
        std::size_t count = 0;
        for (const cv::Vec3b& pixel : picture) {
            count += condition(pixel) ? 1 : 0;
        }
        return static_cast<double>(count) / static_cast<double>(picture.total());
    }

    static int brightness(const cv::Vec3b& pixel) { return (pixel[0] + pixel[1] + pixel[2]) / 3; }
    /// Spheres have colours; paper, text and geometry have hardly any.
    static bool colourful(const cv::Vec3b& pixel) {
        const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
        return most - least > 60;
    }
};

TEST_F(Screenshot, LightAndDark) {
    const cv::Mat3b light = shot(1, 1280, 1000), dark = shot(2, 1280, 1000);
    if (light.empty() || dark.empty()) {
        GTEST_SKIP() << why_not();
    }
    if (light(2, light.cols / 2) == cv::Vec3b(0, 0, 255)) {
        GTEST_SKIP() << "the browser has no WebGL 2 here";
    }
    EXPECT_GT(light(2, 2)[0], 245);
    EXPECT_LT(dark(2, 2)[0], 40);
    // Paper, text on it, and spheres in colour.
    const auto bright = [](const cv::Vec3b& p) { return brightness(p) > 200; };
    const auto shadowy = [](const cv::Vec3b& p) { return brightness(p) < 60; };
    EXPECT_GT(share(light, bright), 0.6);
    EXPECT_GT(share(light, shadowy), 0.002);
    EXPECT_GT(share(dark, shadowy), 0.6);
    EXPECT_GT(share(dark, bright), 0.002);
    for (const cv::Mat3b& picture : {light, dark}) {
        EXPECT_GT(share(picture, colourful), 0.01);
    }
}

TEST_F(Screenshot, NothingSticksOutOnAPhone) {
    report_of(recipe(chain));
    let_in("document.body.dataset.sticksOut = Math.max(0, document.documentElement.scrollWidth - innerWidth);");
    if (!browse(std::string(software_gl) + " --dump-dom --window-size=500,900", "dom.html")) {
        GTEST_SKIP() << why_not();
    }
    EXPECT_THAT(between(read_file(folder.path() / "dom.html"), "<body", ">"),
                ::testing::HasSubstr("data-sticks-out=\"0\""));
}

TEST_F(Screenshot, PrintedAsPages) {
    report_of(recipe(chain));
    if (!browse(std::string(software_gl) + " --print-to-pdf=report.pdf", "said.txt")) {
        GTEST_SKIP() << why_not();
    }
    EXPECT_THAT(read_file(folder.path() / "report.pdf"), ::testing::StartsWith("%PDF-"));
    // What print adds: no button, no controls, and a table that is no wider than A4 between margins of 1 cm.
    std::string html = read_file(folder.path() / "out/report.html");
    const std::string media = "@media print {";
    html.replace(html.find(media), media.size(), "@media all {");
    write_file(folder.path() / "out/report.html", html);
    let_in("const seen = (s) => getComputedStyle(document.querySelector(s)).display;"
           "document.body.dataset.seen = `${seen('.theme')} ${seen('.controls')} ${seen('#links table')}`;"
           "document.body.dataset.wide = document.querySelector('#links table').offsetWidth <= 718;");
    ASSERT_TRUE(browse(std::string(software_gl) + " --dump-dom --window-size=718,900", "dom.html"));
    EXPECT_THAT(between(read_file(folder.path() / "dom.html"), "<body", ">"),
                ::testing::AllOf(::testing::HasSubstr("data-seen=\"none none table\""),
                                 ::testing::HasSubstr("data-wide=\"true\"")));
}

} // namespace
} // namespace foam::test
