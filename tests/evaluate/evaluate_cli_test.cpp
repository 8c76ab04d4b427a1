// foam evaluate, certify and compare as a user runs them.
#include "cli/program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* arm = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="tip"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="j" type="fixed"><parent link="base"/><child link="tip"/><origin xyz="0 0 0.5"/></joint>
</robot>)";

class EvaluateCli : public Cli {
protected:
    EvaluateCli() {
        write("arm.urdf", arm);
        write("good.csv", "link,x,y,z,radius\nbase,0,0,0,0.174\ntip,0,0,0,0.1\n");
        write("thin.yaml", "collision_spheres: {base: [{center: [0, 0, 0], radius: 0.1}], tip: [{center: [0, 0, 0], "
                           "radius: 0.09}]}\n");
        write("half.json", R"({"base": {"centers": [[0, 0, 0]], "radii": [0.2]}})");
    }
};

TEST_F(EvaluateCli, ATableOfAllFigures) {
    const Outcome outcome = foam("evaluate arm.urdf good.csv");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out,
                HasSubstr("good.csv (CSV): 2 spheres for arm.urdf\nlink   spheres      covered %     gap mm"));
    EXPECT_THAT(outcome.out, HasSubstr("\ntip          1   100.00 ±0.00       0.00   0.000 ±0.000   0.000 ±0.000"));
    EXPECT_THAT(outcome.out, HasSubstr("\ntotal        2   100.00 ±0.00       0.00"));
    EXPECT_THAT(outcome.out, EndsWith("yes\nProved: the collision geometry of 2 of 2 links lies inside their spheres, as solids.\n"));
}

TEST_F(EvaluateCli, JsonHasEveryFigure) {
    const Outcome outcome = foam("evaluate arm.urdf thin.yaml --json");
    EXPECT_EQ(outcome.code, 0);
    const json data = json::parse(outcome.out);
    EXPECT_EQ(data["original"], "arm.urdf");
    EXPECT_EQ(data["model"], "thin.yaml");
    EXPECT_EQ(data["model_format"], "collision_spheres YAML");
    ASSERT_EQ(data["links"].size(), 2u);
    const json& base = data["links"][0];
    EXPECT_EQ(base["link"], "base");
    EXPECT_EQ(base["spheres"], 1);
    EXPECT_NEAR(base["volume_m3"].get<double>(), 0.008, 1e-12);
    EXPECT_NEAR(base["area_m2"].get<double>(), 0.24, 1e-12);
    EXPECT_NEAR(base["gap_m"].get<double>(), 0.1 * (std::sqrt(3.0) - 1), 1e-3);
    EXPECT_NEAR(base["missing"].get<double>(), 1 - 4.0 / 3 * 3.14159265 * 0.001 / 0.008, 5e-3);
    for (const char* key : {"covered", "covered_standard_error", "excess", "excess_standard_error",
                            "missing_standard_error", "protrusion_max_m", "protrusion_mean_m", "volume_ratio"}) {
        EXPECT_TRUE(base[key].is_number()) << key;
    }
    EXPECT_FALSE(base["certified"].get<bool>());
    EXPECT_EQ(data["total"]["spheres"], 2);
}

TEST_F(EvaluateCli, HowFarSpheresReachBeyondPlanes) {
    const Outcome outcome = foam("evaluate arm.urdf good.csv --clip base=0,0,-2,0.1 --clip tip=1,0,0,0.25");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, EndsWith("base: 74.000 mm beyond the plane with normal [0, 0, -2], offset 0.1 m\n"
                                      "tip: -150.000 mm beyond the plane with normal [1, 0, 0], offset 0.25 m\n"));
    const json data = json::parse(foam("evaluate arm.urdf good.csv --clip base=0,0,-2,0.1 --json").out);
    EXPECT_EQ(data["clip"][0]["link"], "base");
    EXPECT_EQ(data["clip"][0]["offset_m"], 0.1);
    EXPECT_NEAR(data["clip"][0]["reached_m"].get<double>(), 0.074, 1e-12);
    EXPECT_THAT(foam("evaluate arm.urdf half.json --clip tip=1,0,0,0").out, EndsWith("\ntip: has no spheres\n"));
    for (const std::string bad :
         {"base", "base=0,0,1", "base=0,0,0,1", "base=0,0,1,", "base=0,0,1,x", "base=0,0,inf,1"}) {
        const Outcome refused = foam("evaluate arm.urdf good.csv --clip " + bad);
        EXPECT_EQ(refused.code, 2) << bad;
        EXPECT_THAT(refused.err,
                    HasSubstr("--clip expects LINK=NX,NY,NZ,OFFSET with a normal that is not zero, such as "
                              "base=0,0,-1,5mm; got '" +
                              bad + "'"));
    }
    EXPECT_THAT(foam("evaluate arm.urdf good.csv --clip foot=0,0,1,0").err,
                HasSubstr("--clip foot=0,0,1,0: there is no link 'foot' to evaluate"));
}

TEST_F(EvaluateCli, TheSameBytesOnAnyNumberOfThreads) {
    const Outcome one = foam("evaluate arm.urdf thin.yaml --json -j 1 --seed 7");
    EXPECT_EQ(one.code, 0);
    EXPECT_EQ(foam("evaluate arm.urdf thin.yaml --json -j 3 --seed 7").out, one.out);
    EXPECT_NE(foam("evaluate arm.urdf thin.yaml --json --seed 8").out, one.out);
}

TEST_F(EvaluateCli, LinksWithoutSpheresAreSaid) {
    const Outcome outcome = foam("evaluate arm.urdf half.json");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "foam: warning: half.json: 1 of 2 links with collision geometry have no spheres: tip\n");
    EXPECT_THAT(outcome.out, HasSubstr("\nlinks with spheres        1"));
    EXPECT_THAT(outcome.out, HasSubstr("inf"));
    EXPECT_EQ(foam("evaluate arm.urdf half.json --link base").err, "");
}

/// The name of a link that is left out is no glob.
TEST_F(EvaluateCli, ALinkNamedLikeAGlobLeavesTheOthersIn) {
    const std::string box = "<collision><geometry><box size=\"0.2 0.2 0.2\"/></geometry></collision>";
    write("odd.urdf",
          "<robot name=\"odd\"><link name=\"base\">" + box + "</link><link name=\"*\">" + box +
              "</link><joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"*\"/></joint></robot>");
    write("odd.csv", "link,x,y,z,radius\nbase,0,0,0,0.174\n");
    const Outcome outcome = foam("certify odd.urdf odd.csv --link base");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "Certified in part (outer): the geometry lies inside the spheres on 1 of 2 links, as a solid, 1 sphere.\n"
                           "Not part of the proof: * (excluded by --keep or --skip).\n");
}

TEST_F(EvaluateCli, AMeshIsAnOriginalToo) {
    write("box.obj", box_obj);
    write("rows.txt", "0 0 0 0.1871\n");
    const Outcome outcome = foam("evaluate box.obj rows.txt");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("rows.txt (rows of numbers): 1 sphere for box.obj\n"));
    EXPECT_EQ(foam("certify box.obj rows.txt").code, 0);
}

TEST_F(EvaluateCli, CertifyProves) {
    const Outcome outcome = foam("certify arm.urdf good.csv");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, "Certified (outer): the geometry lies inside the spheres on 2 links, as solids, 2 spheres.\n");
    write("inside.csv", "link,x,y,z,radius\nbase,0,0,0,0.099\ntip,0,0,0,0.09\n");
    EXPECT_EQ(foam("certify arm.urdf inside.csv --guarantee inner").out,
              "Certified (inner): the spheres lie inside the geometry on 2 links, 2 spheres.\n");
}

TEST_F(EvaluateCli, CertifySaysWhereTheProofFails) {
    write("bad.csv", "link,x,y,z,radius\nbase,0,0,0,0.1731\ntip,0,0,0,0.1\n");
    const Outcome outcome = foam("certify arm.urdf bad.csv");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("link  growth mm  triangle  witness, m\nbase   0.105081 "));
    EXPECT_THAT(outcome.out, HasSubstr("Not certified (outer): 1 of 2 links.\nRemedy: make the model again"));
    const Outcome data = foam("certify arm.urdf bad.csv --json");
    EXPECT_EQ(data.code, 1);
    const json proof = json::parse(data.out);
    EXPECT_FALSE(proof["certified"].get<bool>());
    EXPECT_NEAR(proof["links"][0]["growth_m"].get<double>(), 0.1 * std::sqrt(3.0) - 0.1731, 1e-6);
    EXPECT_NEAR(std::abs(proof["links"][0]["witness_m"][2].get<double>()), 0.1, 1e-9);
    EXPECT_TRUE(proof["links"][1]["certified"].get<bool>());
    EXPECT_EQ(proof["links"][0]["triangles"], 12);
    EXPECT_GE(proof["links"][0]["pieces"].get<int>(), 12);
    EXPECT_GE(proof["links"][0]["halvings"].get<int>(), 0);
}

TEST_F(EvaluateCli, ALinkWithoutSpheresIsNotCertified) {
    const Outcome outcome = foam("certify arm.urdf half.json");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("\ntip   it has no elements\n"));
}

TEST_F(EvaluateCli, CompareSideBySide) {
    const Outcome outcome = foam("compare arm.urdf good.csv thin.yaml half.json");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out,
                HasSubstr("A   good.csv (CSV)\nB   thin.yaml (collision_spheres YAML)\nC   half.json (centers "
                          "and radii by link)\n"));
    EXPECT_THAT(outcome.out, HasSubstr("\nA            2     100.00      0.00"));
    EXPECT_THAT(outcome.out, HasSubstr("\nlink   | spheres   excess   gap mm  | spheres   excess   gap mm"));
    EXPECT_THAT(outcome.out, HasSubstr("\ntip    |       1    0.000        0  |       1    0.000    10.4"));
    const json data = json::parse(foam("compare arm.urdf good.csv thin.yaml --json").out);
    ASSERT_EQ(data["models"].size(), 2u);
    EXPECT_EQ(data["models"][1]["model"], "thin.yaml");
    EXPECT_TRUE(data["models"][0]["total"]["certified"].get<bool>());
}

TEST_F(EvaluateCli, CompareWritesAPageThatNeedsNothingElse) {
    write("<b>.yaml", "collision_spheres: {base: [[0, 0, 0, 0.2]], tip: [[0, 0, 0, 0.2]]}\n");
    const Outcome outcome = foam("compare arm.urdf good.csv '<b>.yaml' --html page.html");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, EndsWith("foam: written: page.html\n"));
    const std::string page = contents(path() / "page.html");
    EXPECT_THAT(page, HasSubstr("<td class=\"why\">&lt;b&gt;.yaml</td>"));
    EXPECT_THAT(page, Not(HasSubstr("<b>")));
    EXPECT_THAT(page, HasSubstr("<tfoot><tr><td>total</td><td class=\"first\">2</td>"));
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = page.find("src=\"data:image/png;base64,iVBOR", at)) != page.npos; ++at) {
        ++pictures;
    }
    EXPECT_EQ(pictures, 3u); // of the whole and of each link
    EXPECT_THAT(page, HasSubstr("<h3>base</h3>\n<figure><img alt=\"base under the spheres of each model\""));
    EXPECT_THAT(page, HasSubstr("color-scheme: light dark"));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    EXPECT_THAT(page, Not(HasSubstr("://")));
    EXPECT_THAT(page, EndsWith("</body>\n</html>\n"));
    EXPECT_EQ(
        foam("compare arm.urdf good.csv --html nowhere/page.html").err,
        "foam: error: nowhere/page.html: it cannot be written; remedy: check that its folder exists and has room\n");
}

TEST_F(EvaluateCli, WhatIsWrong) {
    EXPECT_EQ(foam("evaluate arm.urdf none.csv").code, 1);
    EXPECT_EQ(foam("evaluate arm.urdf none.csv").err,
              "foam: error: none.csv: there is no such file; remedy: check the path\n");
    EXPECT_EQ(foam("evaluate none.urdf good.csv").code, 1);
    EXPECT_EQ(foam("evaluate arm.urdf good.csv --rename base").err,
              "foam: error: --rename expects OLD=NEW, got 'base'\n");
    EXPECT_EQ(foam("certify arm.urdf good.csv --guarantee fitted").code, 2);
    write("broken.yaml", "collision_spheres: {base: [{center: [0, 0, 0]}]}\n");
    EXPECT_EQ(foam("evaluate arm.urdf broken.yaml").err,
              "foam: error: broken.yaml:1:28: expected a map with the key 'radius', got one without\n");
}

} // namespace
} // namespace foam::test
