// What commands say of a result: of which links it is proved, in which words, and where the time went.
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class CliStatement : public Cli {
protected:
    void SetUp() override {
        write("three.urdf",
              "<robot name='three'>\n"
              "<link name='base'><collision><geometry><box size='0.4 0.2 0.2'/></geometry></collision></link>\n"
              "<link name='tip'><collision><geometry><box size='0.1 0.1 0.3'/></geometry></collision></link>\n"
              "<link name='camera'><visual><geometry><sphere radius='0.1'/></geometry></visual></link>\n"
              "<joint name='j' type='fixed'><parent link='base'/><child link='tip'/></joint>\n"
              "<joint name='k' type='fixed'><parent link='tip'/><child link='camera'/></joint>\n"
              "</robot>\n");
        write("three.yaml", "foam: 1\nrobot: {urdf: three.urdf}\nstages: [spherize.grid]\n"
                            "outputs: [write.urdf: {file: out.urdf}, write.json: {file: out.json}]\n");
    }
    json manifest() const { return json::parse(contents(path() / "runs/three/manifest.json")); }
};

constexpr const char* both_proved = "Proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids.\n"
                                    "1 link has visual geometry only and no spheres: camera.\n";

TEST_F(CliStatement, AllThatHasCollisionGeometryIsProved) {
    const Outcome outcome = foam("run three.yaml");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(both_proved));
    EXPECT_TRUE(manifest()["certified"]);
    EXPECT_EQ(manifest()["proof"],
              json::parse(R"({"geometry": "collision", "links_with_geometry": 2, "links_proved": 2, "missing": 0.0,
                              "statement": "proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids",
                              "as_surface": [], "left_out": [], "visual_only": ["camera"], "collision_only": []})"));
    EXPECT_THAT(contents(path() / "runs/three/report.html"),
                HasSubstr("Proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids."));
    const Outcome certified = foam("certify three.urdf runs/three/out.urdf");
    EXPECT_EQ(certified.code, 0) << certified.err;
    EXPECT_THAT(certified.out, HasSubstr("on 2 links, "));
    EXPECT_THAT(certified.out, HasSubstr("1 link has visual geometry only and no spheres: camera.\n"));
}

TEST_F(CliStatement, ALinkThatTheRecipeLeavesOutIsNotProved) {
    const Outcome outcome = foam("run three.yaml --set links.base.skip=true");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string sentences = "Proved in part: the collision geometry of 1 of 2 links lies inside their spheres, as a solid.\n"
                                  "Not part of the proof: base (skip in the recipe).\n"
                                  "1 link has visual geometry only and no spheres: camera.\n";
    EXPECT_THAT(outcome.out, HasSubstr(sentences));
    EXPECT_FALSE(manifest()["certified"]);
    EXPECT_EQ(manifest()["proof"]["links_proved"], 1);
    EXPECT_EQ(manifest()["proof"]["left_out"], json::parse(R"([{"link": "base", "reason": "skip in the recipe"}])"));
    EXPECT_THAT(contents(path() / "runs/three/report.html"),
                HasSubstr("Not part of the proof: base (skip in the recipe)."));
    const json run = json::parse(foam("run three.yaml --set links.base.skip=true --json").out)["runs"][0];
    EXPECT_FALSE(run["certified"]);
    EXPECT_EQ(run["proof"], manifest()["proof"]);
    // As a model the file has the box that the link keeps, which contains the link.
    EXPECT_EQ(foam("certify three.urdf runs/three/out.urdf").code, 0);
    const json evaluated = json::parse(foam("evaluate three.urdf runs/three/out.urdf --json").out);
    EXPECT_EQ(evaluated["proof"]["links_proved"], 2);
    EXPECT_EQ(evaluated["proof"]["links_with_geometry"], 2);
}

TEST_F(CliStatement, ALinkThatIsLostIsNotProved) {
    write("broken.obj", "v 0 0 0\n");
    write("three.urdf",
          "<robot name='three'><link name='base'><collision><geometry><mesh filename='broken.obj'/></geometry>"
          "</collision></link><link name='tip'><collision><geometry><box size='0.1 0.1 0.3'/></geometry>"
          "</collision></link><joint name='j' type='fixed'><parent link='base'/><child link='tip'/></joint>"
          "</robot>");
    const Outcome outcome = foam("run three.yaml --set on_error=skip --json");
    ASSERT_EQ(outcome.code, 4) << outcome.err;
    const json run = json::parse(outcome.out)["runs"][0];
    EXPECT_FALSE(run["certified"]);
    EXPECT_EQ(run["proof"]["left_out"], json::parse(R"([{"link": "base", "reason": "on_error: skip"}])"));
}

TEST_F(CliStatement, LinksThatWereNotAskedForAreNamed) {
    ASSERT_EQ(foam("run three.yaml").code, 0);
    const Outcome outcome = foam("certify three.urdf runs/three/out.urdf --link tip");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("Certified in part (outer): the geometry lies inside the spheres on 1 of 2 links, "));
    EXPECT_THAT(outcome.out, HasSubstr("Not part of the proof: base (excluded by --keep or --skip).\n"));
    const json certified = json::parse(foam("certify three.urdf runs/three/out.urdf --link tip --json").out);
    EXPECT_FALSE(certified["certified"]);
    EXPECT_EQ(certified["proof"]["links_proved"], 1);
    const Outcome evaluated = foam("evaluate three.urdf runs/three/out.urdf --link tip");
    EXPECT_THAT(evaluated.out, HasSubstr("in part\nProved in part: the collision geometry of 1 of 2 links lies inside "
                                         "their spheres, as a solid.\nNot part of the proof: base (excluded by --keep or --skip).\n"));
    const Outcome compared = foam("compare three.urdf runs/three/out.urdf --link tip --html page.html");
    EXPECT_THAT(compared.out, HasSubstr("\nA   Proved in part: the collision geometry of 1 of 2 links lies inside"));
    EXPECT_THAT(contents(path() / "page.html"), HasSubstr("<td class=\"no\">in part</td>"));
}

/// Nothing is proved, and the sentence says so; a link without elements does not fail a proof.
TEST_F(CliStatement, AFittedModelIsSaidToBeUnproved) {
    const Outcome outcome = foam("run three.yaml --set guarantee=fitted --set stages=[spherize.cover]");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\nNothing is proved (guarantee: fitted).\n"));
}

/// A time limit that is over at once leaves the proved files, and no word of a report that is not there.
TEST_F(CliStatement, AShortTimeLimitLeavesAProvedResult) {
    const Outcome outcome = foam("run three.yaml --fresh --time-limit 0.000001");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\nProved: the collision geometry of 2 of 2 links lies inside their spheres, as solids.\n"));
    EXPECT_EQ(outcome.out.find("Report: ") != outcome.out.npos, std::filesystem::exists(path() / "runs/three/report.html"))
        << outcome.out;
}

/// The names of figures in whatever programs read.
TEST_F(CliStatement, FiguresHaveOneSetOfNames) {
    ASSERT_EQ(foam("run three.yaml").code, 0);
    const json run = json::parse(foam("run three.yaml --json").out)["runs"][0];
    const auto names = [](const json& object) {
        std::vector<std::string> keys;
        for (const auto& [key, value] : object.items()) {
            keys.push_back(key);
        }
        return keys;
    };
    const std::vector<std::string> figures = names(run["total"]);
    EXPECT_THAT(figures, ::testing::IsSupersetOf({"spheres", "area_m2", "volume_m3", "covered", "gap_m", "excess",
                                                  "excess_standard_error", "missing", "missing_standard_error",
                                                  "protrusion_max_m", "protrusion_mean_m", "certified"}));
    EXPECT_EQ(names(manifest()["total"]), figures);
    EXPECT_EQ(names(manifest()["links"][0]["measures"]), figures);
    const json spheres = json::parse(contents(path() / "runs/three/out.json"));
    EXPECT_EQ(names(spheres["links"]["tip"]["groups"][0]["measures"]), figures);
    EXPECT_THAT(names(run["links"][0]), ::testing::IsSupersetOf(figures));
    EXPECT_THAT(names(run["links"][0]), ::testing::Contains("growth_m"));
    EXPECT_THAT(names(run), ::testing::IsSupersetOf({"wall_seconds", "cpu_seconds"}));
    const json evaluated = json::parse(foam("evaluate three.urdf runs/three/out.urdf --json").out);
    EXPECT_THAT(names(evaluated["total"]), ::testing::IsSupersetOf(figures));
    const json compared = json::parse(foam("compare three.urdf runs/three/out.urdf --json").out);
    EXPECT_EQ(names(compared["models"][0]["total"]), names(evaluated["total"]));
}

TEST_F(CliStatement, TimesOfPhasesAddUp) {
    const Outcome outcome = foam("run three.yaml --fresh --set snapshots=true --set debug.meshes=true");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json execution = manifest()["execution"];
    double wall = 0, cpu = 0;
    std::vector<std::string> phases;
    for (const json& phase : execution["phases"]) {
        wall += phase["wall_seconds"].get<double>();
        cpu += phase["cpu_seconds"].get<double>();
        phases.push_back(phase["phase"]);
    }
    EXPECT_EQ(phases, (std::vector<std::string>{"reading", "filters", "spheres", "growth", "measures", "writing",
                                                "proof", "debug meshes", "pictures", "visual geometry", "other"}));
    EXPECT_NEAR(wall, execution["wall_seconds"].get<double>(), 1e-9);
    EXPECT_NEAR(cpu, execution["cpu_seconds"].get<double>(), 1e-9);
    const std::string report = contents(path() / "runs/three/report.html");
    for (const std::string& phase : phases) {
        EXPECT_THAT(report, HasSubstr("<th scope=\"row\">" + phase + "</th>"));
    }
}

} // namespace
} // namespace foam::test
