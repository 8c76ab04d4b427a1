// The report as a browser shows it.
#include "browser.hpp"

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportInBrowser : public InBrowser {
protected:
    /// The document of out/report.html after its scripts have run; empty if the browser does not start here.
    std::string document(const std::string& options = "") const {
        return browse("--dump-dom " + options, "dom.html") ? read_file(folder.path() / "dom.html") : "";
    }
};

std::string attribute(const std::string& key, std::size_t first, std::size_t second) {
    return key + "=\"" + std::to_string(first) + "," + std::to_string(second) + "\"";
}

constexpr const char* short_chain = "stages: [repair.auto, spherize.octree]\nbudget: {spheres: 9}\n";

TEST_F(ReportInBrowser, DrawsEveryLinkAndRunsNoForeignScript) {
    report_of(recipe(short_chain));
    const std::string html = document(software_gl);
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

/// Clicks, and writes what came of it into attributes of the body.
constexpr const char* visitor = R"(
const column = () => [...document.querySelectorAll("#links tbody tr")].map((row) => row.cells[1].textContent).join();
const head = document.querySelectorAll("#links thead button")[1], told = document.body.dataset;
head.click();
told.ascending = column();
head.click();
told.descending = column();
document.querySelector("#links tr[data-link=tip] th button").click();
const level = document.getElementById("level");
level.value = 0;
level.dispatchEvent(new Event("input"));
setTimeout(() => {
  const viewer = document.getElementById("viewer").dataset;
  told.alone = document.querySelector("#link-list input:checked").parentNode.textContent;
  told.drawn = `${viewer.links} ${viewer.meshes} ${viewer.spheres}`;
}, 1000);
)";

TEST_F(ReportInBrowser, SortsFiguresAndShowsALinkAlone) {
    report_of(recipe(short_chain));
    let_in(visitor);
    const std::string shown = document(software_gl);
    if (shown.empty()) {
        GTEST_SKIP() << "the browser does not start here: " << read_file(folder.path() / "browser.txt");
    }
    if (shown.find("data-error=\"this browser has no WebGL 2") != shown.npos) {
        GTEST_SKIP() << "the browser has no WebGL 2 here";
    }
    std::vector<std::size_t> counts{result.links[0].measures.spheres, result.links[1].measures.spheres};
    std::sort(counts.begin(), counts.end());
    const std::string body = between(shown, "<body", ">");
    EXPECT_THAT(body, HasSubstr(attribute("data-ascending", counts[0], counts[1])));
    EXPECT_THAT(body, HasSubstr(attribute("data-descending", counts[1], counts[0])));
    EXPECT_THAT(body, AllOf(HasSubstr("data-alone=\"tip\""), HasSubstr("data-drawn=\"1 1 1\"")));
}

TEST_F(ReportInBrowser, SaysWhatIsMissingWithoutWebGl) {
    report_of(recipe(short_chain));
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
