// The report that every run writes.
#include "fixture.hpp"
#include "support/read_spheres.hpp"

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* chain = "stages: [repair.auto, smooth.humphrey: {volume_tolerance: 0.5}, spherize.octree]\n"
                              "budget: {spheres: 9}\n";

/// Without what may differ between two runs of a recipe.
std::string without_execution(std::string html) {
    const std::string begin = "<!--execution-->", end = "<!--/execution-->";
    for (std::size_t at = 0; (at = html.find(begin)) != html.npos;) {
        html.erase(at, html.find(end, at) + end.size() - at);
    }
    return html;
}

TEST_F(ReportOfRun, IsAmongTheFilesOfTheRun) {
    report_of(recipe(chain));
    EXPECT_THAT(result.files, ::testing::Contains(std::filesystem::path("report.html")));
}

TEST_F(ReportOfRun, SaysWhatTheRunSays) {
    const std::string html = report_of(recipe(chain));
    EXPECT_THAT(html, AllOf(HasSubstr("<h1>arm</h1>"),
                            HasSubstr("<p class=\"verdict yes\">Proved: the collision geometry of 2 of 2 links "
                                      "lies inside their spheres, 1 as a solid, 1 as a surface.\nAs a surface: "),
                            HasSubstr("<dt>Spheres</dt><dd>" + std::to_string(result.total.spheres) +
                                      "<small>budget 9</small>"),
                            HasSubstr("<tr data-link=\"tip\"><th scope=\"row\">tip</th>"),
                            HasSubstr("numbers read back from <code>arm.urdf</code>, <code>arm.json</code>"),
                            HasSubstr("<code>foam verify .</code>"), HasSubstr("<strong>repair.auto</strong> ")));
    const auto manifest = nlohmann::json::parse(read_file(folder.path() / "out/manifest.json"));
    for (const char* list : {"mesh_files", "outputs"}) {
        for (const auto& file : manifest[list]) {
            EXPECT_THAT(html, HasSubstr(file["digest"].get<std::string>()));
        }
    }
    EXPECT_THAT(html, HasSubstr(manifest["input"]["digest"].get<std::string>()));
    EXPECT_THAT(html, HasSubstr("largest_hole: 0.1")); // the recipe with its defaults
}

TEST_F(ReportOfRun, SaysWhatTheProofTook) {
    const std::string html = report_of(recipe(chain));
    const auto manifest = nlohmann::json::parse(read_file(folder.path() / "out/manifest.json"));
    for (const auto& output : manifest["outputs"]) {
        ASSERT_EQ(output["proofs"].size(), 2u);
        const auto& box = output["proofs"][0];
        EXPECT_EQ(box["link"], hostile_link);
        EXPECT_EQ(box["triangles"], 10); // five quadrilaterals
        EXPECT_GE(box["pieces"].get<int>(), 10);
        EXPECT_THAT(html, HasSubstr("<code>" + output["file"].get<std::string>() + "</code>: 2 links, "));
    }
    EXPECT_THAT(html, HasSubstr("<th scope=\"col\">pieces</th><th scope=\"col\">halvings</th>"));
    const std::string inner = report_of(recipe(std::string(chain) + "guarantee: inner\n"), "inner");
    EXPECT_THAT(inner, HasSubstr("<code>arm.urdf</code>: "));
    EXPECT_THAT(inner, Not(HasSubstr("<th scope=\"col\">pieces</th>")));
}

TEST_F(ReportOfRun, HoldsTheSpheresThatWereWritten) {
    const auto scene = scene_of(report_of(recipe(chain)));
    const auto written = read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/arm.urdf"));
    ASSERT_EQ(scene["links"].size(), written.size());
    for (const auto& link : scene["links"]) {
        const std::vector<Sphere>& spheres = written.at(link["name"].get<std::string>());
        const auto drawn = values<float>(link["levels"].back());
        ASSERT_EQ(drawn.size(), 4 * spheres.size());
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            EXPECT_EQ(drawn[4 * i], static_cast<float>(spheres[i].center.x));
            EXPECT_EQ(drawn[4 * i + 1], static_cast<float>(spheres[i].center.y));
            EXPECT_EQ(drawn[4 * i + 2], static_cast<float>(spheres[i].center.z));
            EXPECT_EQ(drawn[4 * i + 3], static_cast<float>(spheres[i].radius));
        }
        EXPECT_EQ(values<float>(link["levels"].front()).size(), 4u); // the bounding sphere
    }
    EXPECT_EQ(scene["links"][1]["pose"], nlohmann::json({1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0.3}));
    EXPECT_EQ(scene["links"][0]["meshes"].size(), 3u); // original, repaired, smoothed
}

TEST_F(ReportOfRun, NamesAreTextWhateverTheyHold) {
    const std::string html = report_of(recipe(chain));
    EXPECT_THAT(html, Not(HasSubstr(hostile_link)));
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;document.title='broken'&lt;/script&gt;"));
    EXPECT_THAT(html, AllOf(Not(HasSubstr("a<b>")), HasSubstr("a&lt;b&gt;&amp;.obj")));
    EXPECT_THAT(html, AllOf(Not(HasSubstr("arm </title>")), HasSubstr("arm &lt;/title&gt;")));
    EXPECT_EQ(scene_of(html)["links"][0]["name"], hostile_link);
}

TEST_F(ReportOfRun, SameBytesOnOneAndFourThreadsButForTimes) {
    const Recipe wanted = recipe(chain);
    const std::string one = report_of(wanted, "one", 1), four = report_of(wanted, "four", 4);
    EXPECT_EQ(without_execution(one), without_execution(four));
    EXPECT_THAT(one, HasSubstr("before this report."));
    EXPECT_THAT(without_execution(one), Not(HasSubstr("before this report.")));
}

TEST_F(ReportOfRun, ALinkThatIsLeftOutHasNoFigures) {
    const std::string html = report_of(recipe("stages: [spherize.grid]\nlinks: {tip: {skip: true}}\n"));
    EXPECT_THAT(
        html, AllOf(HasSubstr("<th scope=\"row\">tip</th><td class=\"why\" colspan=\"10\">excluded by the recipe</td>"),
                    HasSubstr("<small>1 excluded by the recipe</small>"),
                    HasSubstr("Not part of the proof: tip (skip in the recipe).")));
    EXPECT_EQ(scene_of(html)["links"].size(), 1u);
}

TEST_F(ReportOfRun, WithoutAGuaranteeItSaysSo) {
    const std::string html =
        report_of(recipe("stages: [spherize.grid, refine.fit]\nbudget: {spheres: 9}\nguarantee: fitted\n"));
    EXPECT_THAT(html, HasSubstr("<p class=\"verdict plain\">No guarantee was asked for"));
    EXPECT_THAT(html, Not(HasSubstr("foam certify")));
}

TEST_F(ReportOfRun, InnerIsSeenThroughTheGeometry) {
    write_file(folder.path() / "box.urdf", "<robot name=\"box\"><link name=\"box\"><collision><geometry><box "
                                           "size=\"1 1 1\"/></geometry></collision></link></robot>");
    const std::string html = report_of(
        recipe("stages: [spherize.grid]\nbudget: {spheres: 9}\nguarantee: inner\n", "robot: {urdf: box.urdf}"));
    EXPECT_THAT(html, AllOf(HasSubstr("Proved: the spheres of 1 of 1 link lie inside its collision geometry."),
                            HasSubstr("name=\"clear\" value=\"geometry\" checked"),
                            HasSubstr("arm.urdf' --guarantee inner")));
}

TEST_F(ReportOfRun, OfASingleMesh) {
    const std::string html = report_of(recipe("stages: [spherize.octree]\nbudget: {spheres: 4}\n", "mesh: a<b>&.obj"));
    EXPECT_THAT(html, HasSubstr("<dt>Links</dt><dd>1<small>with collision geometry</small>"));
    EXPECT_THAT(html, AllOf(HasSubstr("a&lt;b&gt;&amp;.obj"), Not(HasSubstr("a<b>"))));
}

} // namespace
} // namespace foam::test
