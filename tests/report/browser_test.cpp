// The report as a browser shows it.
#include "fixture.hpp"

#include <cstdlib>
#include <sys/wait.h>

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportInBrowser : public ReportOfRun {
protected:
    void SetUp() override {
        if (std::string(FOAM_TEST_CHROMIUM).empty()) {
            GTEST_SKIP() << "chromium is not installed";
        }
    }

    /// The document of out/report.html after its scripts have run; empty if the browser does not start here.
    std::string document(const std::string& options = "") const {
        const std::string dir = folder.path().string();
        const std::string command = "cd '" + dir + "' && HOME='" + dir +
                                    "' timeout 200 '" FOAM_TEST_CHROMIUM
                                    "' --headless --no-sandbox --disable-gpu --no-first-run --user-data-dir='" +
                                    dir + "/profile' --virtual-time-budget=20000 " + options + " --dump-dom 'file://" +
                                    dir + "/out/report.html' >dom.html 2>browser.txt";
        const int status = std::system(command.c_str());
        return status == 0 ? read_file(folder.path() / "dom.html") : "";
    }
};

constexpr const char* chain = "stages: [repair.auto, spherize.octree]\nbudget: {spheres: 9}\n";

TEST_F(ReportInBrowser, DrawsEveryLinkAndRunsNoForeignScript) {
    report_of(recipe(chain));
    const std::string html = document("--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader");
    if (html.empty()) {
        GTEST_SKIP() << "the browser does not start here: " << read_file(folder.path() / "browser.txt");
    }
    const std::string canvas = between(html, "<canvas id=\"viewer\"", ">");
    if (canvas.find("data-error=\"this browser has no WebGL 2") != canvas.npos) {
        GTEST_SKIP() << "the browser has no WebGL 2 here";
    }
    EXPECT_THAT(canvas,
                AllOf(HasSubstr("data-ready=\"yes\""), HasSubstr("data-links=\"2\""), HasSubstr("data-meshes=\"2\""),
                      HasSubstr("data-spheres=\"" + std::to_string(result.total.spheres) + "\""),
                      Not(HasSubstr("data-error")), Not(HasSubstr("hidden"))));
    EXPECT_THAT(html, AllOf(HasSubstr("<title>arm as spheres</title>"), HasSubstr("class=\"theme\">Theme: system"),
                            HasSubstr("<th scope=\"col\"><button type=\"button\">excess</button></th>")));
}

TEST_F(ReportInBrowser, SaysWhatIsMissingWithoutWebGl) {
    report_of(recipe(chain));
    const std::string html = document("--disable-3d-apis");
    if (html.empty()) {
        GTEST_SKIP() << "the browser does not start here: " << read_file(folder.path() / "browser.txt");
    }
    EXPECT_THAT(between(html, "id=\"viewer-message\"", "</p>"),
                HasSubstr("There is no 3-D view: this browser has no WebGL 2, or it is switched off. All figures are "
                          "in the tables below."));
    EXPECT_THAT(between(html, "<canvas id=\"viewer\"", ">"), HasSubstr("hidden"));
}

} // namespace
} // namespace foam::test
