// What recipes ask for links beyond the search: padding, spheres that stay, no collision geometry, shares, and which
// geometry is covered.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/measure.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace foam {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* grid_12 = "stages: [spherize.grid]\nbudget: {spheres: 12}\n";

std::vector<Sphere> spheres_of_link(const RunResult& result, const std::string& link) {
    for (const SphereGroup& group : result.model.groups) {
        if (group.link == link) {
            return group.tree.finest();
        }
    }
    return {};
}

class RunLinks : public Run {
protected:
    RunResult result_of(const std::string& rest) { return run(recipe(rest), registry, options()); }
    nlohmann::json manifest() const { return nlohmann::json::parse(read_file(folder.path() / "out/manifest.json")); }
    std::map<std::string, std::vector<Sphere>> written() const {
        return test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf"));
    }
};

TEST_F(RunLinks, PaddingGrowsEveryRadiusAndTellsTheExcessBefore) {
    const RunResult bare = result_of(grid_12);
    const RunResult padded = result_of(std::string(grid_12) + "pad: 10mm\nlinks: {tip: {pad: 0}}\n");
    const auto before = spheres_of_link(bare, "base"), after = spheres_of_link(padded, "base");
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].center, after[i].center);
        EXPECT_GE(after[i].radius, before[i].radius + 0.01);
        EXPECT_LE(after[i].radius, before[i].radius + 0.01001);
    }
    EXPECT_EQ(spheres_of_link(bare, "tip"), spheres_of_link(padded, "tip"));
    ASSERT_TRUE(padded.total_unpadded);
    EXPECT_EQ(padded.total_unpadded->excess, bare.total.excess);
    EXPECT_GT(padded.total.excess, bare.total.excess);
    EXPECT_TRUE(padded.certified);
    EXPECT_EQ(manifest()["links"][0]["pad_m"], 0.01);
    EXPECT_EQ(manifest()["links"][0]["excess_unpadded"], bare.links[0].measures.excess);
    EXPECT_FALSE(manifest()["links"][1].contains("pad_m"));
    EXPECT_EQ(manifest()["total"]["excess_unpadded"], bare.total.excess);
}

TEST_F(RunLinks, KeptSpheresStayAndTheOthersCoverTheRest) {
    // Half of the box lies in the kept sphere, so two others are enough for a tight cover of the rest.
    const RunResult result =
        result_of("stages: [spherize.cover]\nbudget: {spheres: 8}\nlinks: {base: {keep: [[0.1, 0, 0.1, 0.175]]}}\n");
    const auto spheres = spheres_of_link(result, "base");
    EXPECT_THAT(spheres, Contains(Sphere{{0.1, 0, 0.1}, 0.175}));
    EXPECT_TRUE(result.certified);
    EXPECT_LE(result.total.spheres, 8u);
    EXPECT_EQ(written()["base"], spheres);
    for (const Sphere& sphere : spheres) {
        EXPECT_TRUE(sphere.center.x < 0.05 || sphere.center.x == 0.1) << "the kept half needs no other sphere";
    }
}

TEST_F(RunLinks, KeptSpheresThatCoverTheLinkAreAllOfIts) {
    const RunResult result =
        result_of("stages: [spherize.grid]\nbudget: {spheres: 8}\n"
                  "links: {base: {keep: [[0.1, 0, 0.1, 0.175], [-0.1, 0, 0.1, 0.175]], min_spheres: 3}}\n");
    EXPECT_EQ(spheres_of_link(result, "base").size(), 2u);
    EXPECT_TRUE(result.certified);
    EXPECT_GT(spheres_of_link(result, "tip").size(), 1u);
    EXPECT_THAT(warnings_of(result), Contains(HasSubstr("base: the 2 spheres that it keeps cover it")));
}

TEST_F(RunLinks, TheRecipeOfAResultGivesItAgain) {
    const RunResult first = result_of("stages: [spherize.cover]\nbudget: {spheres: 9}\n");
    std::string keep;
    for (const Sphere& s : spheres_of_link(first, "base")) {
        keep += (keep.empty() ? "[" : ", [") + number_text(s.center.x) + ", " + number_text(s.center.y) + ", " +
                number_text(s.center.z) + ", " + number_text(s.radius) + "]";
    }
    const RunResult again =
        result_of("stages: [spherize.cover]\nbudget: {spheres: 9}\nlinks: {base: {keep: [" + keep + "]}}\n");
    EXPECT_EQ(spheres_of_link(first, "base"), spheres_of_link(again, "base"));
    EXPECT_TRUE(again.certified);
}

TEST_F(RunLinks, TooFewSpheresForWhatIsKeptIsAnError) {
    EXPECT_THAT(failure("stages: [spherize.grid]\nbudget: {spheres: 8}\n"
                        "links: {base: {keep: [[0.1, 0, 0.1, 0.1]], spheres: 1}}\n"),
                HasSubstr("the link keeps 1 sphere, which leave geometry uncovered, and is to have at most 1"));
    EXPECT_THAT(failure("stages: [spherize.grid]\nbudget: {spheres: 2}\n"
                        "links: {base: {keep: [[0.1, 0, 0.1, 0.1]]}}\n"),
                HasSubstr("budget.spheres: 2 is not enough: links keep 1 spheres"));
}

TEST_F(RunLinks, AFixedNumberOfSpheres) {
    const RunResult result = result_of("stages: [spherize.cover]\nbudget: {spheres: 20}\nlinks: {tip: {spheres: 3}}\n");
    EXPECT_EQ(spheres_of_link(result, "tip").size(), 3u);
    EXPECT_GT(spheres_of_link(result, "base").size(), 3u);
}

TEST_F(RunLinks, ALinkWithoutCollisionGeometryInTheOutput) {
    const RunResult result = result_of(std::string(grid_12) + "links: {tip: {collision: none}}\n");
    EXPECT_TRUE(spheres_of_link(result, "tip").empty());
    EXPECT_FALSE(result.certified) << "not of all";
    ASSERT_EQ(result.proved.left_out.size(), 1u);
    EXPECT_EQ(result.proved.left_out[0].reason, "collision: none in the recipe");
    const std::string urdf = read_file(folder.path() / "out/two.urdf");
    EXPECT_THAT(urdf, HasSubstr("<link name=\"tip\"></link>"));
    const RunResult skipped = result_of(std::string(grid_12) + "links: {tip: {skip: true}}\n");
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<cylinder radius=\"0.05\" length=\"0.3\"/>"));
}

TEST_F(RunLinks, EvenSharesGiveSmallLinksMore) {
    write("pair.urdf", R"(<robot name="two"><link name="large"><collision><geometry><box size="1 0.4 0.2"/></geometry>
</collision></link><link name="small"><collision><geometry><box size="0.1 0.04 0.02"/></geometry></collision></link>
<joint name="j" type="fixed"><origin xyz="0 0 2"/><parent link="large"/><child link="small"/></joint></robot>)");
    const auto small_count = [&](const std::string& share) {
        const RunResult result = run(recipe_of("name: two\nrobot: {urdf: pair.urdf}\nstages: [spherize.cover]\n"
                                               "budget: {spheres: 16" +
                                               share + "}\n"),
                                     registry, options());
        return spheres_of_link(result, "small").size();
    };
    EXPECT_LE(small_count(""), 2u);
    EXPECT_EQ(small_count(", share: even"), 8u) << "the same shape, a tenth of the size";
    EXPECT_GT(small_count(", share: protrusion"), 1u);
}

TEST_F(RunLinks, SmallLinksWithLooseSpheresAreTold) {
    write("hand.urdf", R"(<robot name="two"><link name="palm"><collision><geometry><box size="1 0.4 0.2"/></geometry>
</collision></link><link name="finger"><collision><geometry><box size="0.1 0.01 0.01"/></geometry></collision></link>
<joint name="j" type="fixed"><origin xyz="0 0 2"/><parent link="palm"/><child link="finger"/></joint></robot>)");
    const std::string rest = "name: two\nrobot: {urdf: hand.urdf}\nstages: [spherize.cover]\nbudget: {spheres: 12";
    const auto warnings = [&](const std::string& share) {
        return warnings_of(run(recipe_of(rest + share + "}\n"), registry, options()));
    };
    EXPECT_THAT(warnings(""), Contains(HasSubstr("few spheres fit a small link loosely: finger: excess ")));
    EXPECT_THAT(warnings(", share: even"), ::testing::Not(Contains(HasSubstr("loosely"))));
}

constexpr const char* dressed = R"(<robot name="two">
  <link name="base"><visual><geometry><box size="0.4 0.2 0.3"/></geometry></visual>
    <collision><geometry><box size="0.4 0.2 0.2"/></geometry></collision></link>
  <link name="tip"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <link name="bare"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="j" type="fixed"><origin xyz="0 0 0.5"/><parent link="base"/><child link="tip"/></joint>
  <joint name="k" type="fixed"><origin xyz="0 0 1"/><parent link="base"/><child link="bare"/></joint>
</robot>)";

TEST_F(RunLinks, CoversTheVisualGeometryOnRequest) {
    write("two.urdf", dressed);
    const RunResult result = result_of(std::string(grid_12) + "cover: visual\n");
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.proved.with_geometry, 2u);
    EXPECT_EQ(result.proved.collision_only, std::vector<std::string>{"bare"});
    EXPECT_EQ(result.proved.visual_only, std::vector<std::string>{});
    EXPECT_EQ(verdict_of(result.proved), "Proved: the visual geometry of 2 of 2 links lies inside their spheres, as solids.\n");
    EXPECT_EQ(omissions_of(result.proved), "1 link has collision geometry only and no spheres: bare.\n");
    double top = 0;
    for (const Sphere& sphere : spheres_of_link(result, "base")) {
        top = std::max(top, sphere.center.z + sphere.radius);
    }
    EXPECT_GE(top, 0.15);
    EXPECT_FALSE(spheres_of_link(result, "tip").empty());
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<box size=\"0.1 0.1 0.1\"/>")) << "as it was";
}

TEST_F(RunLinks, CoversBothOnRequest) {
    write("two.urdf", dressed);
    const RunResult result = result_of(std::string(grid_12) + "cover: both\n");
    EXPECT_EQ(result.proved.proved, 3u);
    EXPECT_EQ(verdict_of(result.proved),
              "Proved: the collision and visual geometry of 3 of 3 links lies inside their spheres, as solids.\n");
    EXPECT_THAT(manifest()["proof"]["geometry"], "both");
}

TEST_F(RunLinks, TellsTheGapToTheVisualGeometry) {
    write("two.urdf", dressed);
    const RunResult result = result_of(std::string(grid_12));
    ASSERT_TRUE(result.links[0].visual_gap);
    const auto spheres = spheres_of_link(result, "base");
    double least = 1; // from the corner of the visual box to the nearest sphere
    for (const Sphere& sphere : spheres) {
        least = std::min(least, distance(sphere.center, Vec3{0.2, 0.1, 0.15}) - sphere.radius);
    }
    EXPECT_GE(result.links[0].visual_gap->length, least);
    EXPECT_GT(result.links[0].visual_gap->length, 0);
    EXPECT_LT(result.links[0].visual_gap->length, 0.051) << "the visual box is 50 mm higher";
    EXPECT_FALSE(result.links[1].visual_gap) << "it has no visual geometry";
    EXPECT_THAT(read_file(folder.path() / "out/report.html"), HasSubstr("visual gap mm"));
    write("two.urdf", R"(<robot name="two"><link name="base"><visual><geometry><mesh filename="no.stl"/></geometry>
</visual><collision><geometry><box size="0.4 0.2 0.2"/></geometry></collision></link></robot>)");
    const RunResult lost = result_of(std::string(grid_12));
    ASSERT_TRUE(lost.links[0].visual_gap);
    EXPECT_THAT(lost.links[0].visual_gap->unknown, HasSubstr("mesh 'no.stl' of link"));
    EXPECT_TRUE(lost.certified);
    EXPECT_THAT(failure(std::string(grid_12) + "cover: visual\n"), HasSubstr("mesh 'no.stl' of link"));
}

constexpr const char* tube = R"(<robot name="two"><link name="base">
<collision><origin xyz="0 0.1 0"/><geometry><box size="0.4 0.004 0.204"/></geometry></collision>
<collision><origin xyz="0 -0.1 0"/><geometry><box size="0.4 0.004 0.204"/></geometry></collision>
<collision><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.204 0.004"/></geometry></collision>
<collision><origin xyz="0 0 -0.1"/><geometry><box size="0.4 0.204 0.004"/></geometry></collision>
</link></robot>)";

TEST_F(RunLinks, TheInsideOfATubeCountsOnRequest) {
    write("two.urdf", tube);
    const RunResult empty = result_of("stages: [spherize.cover]\nbudget: {spheres: 6}\n");
    const RunResult full = result_of("stages: [spherize.cover]\nbudget: {spheres: 6}\nhollow: fill\n");
    EXPECT_THAT(manifest()["links"][0].value("filled_volume_m3", 0.0), ::testing::Gt(0.5 * 0.4 * 0.2 * 0.2));
    EXPECT_LT(full.links[0].filled, 0.4 * 0.2 * 0.2);
    EXPECT_GT(empty.total.excess, 5 * full.total.excess) << "its walls have little volume";
    EXPECT_TRUE(full.certified);
    EXPECT_EQ(full.links[0].measures.area, empty.links[0].measures.area);
    const auto told = [](const RunResult& result) {
        return std::any_of(result.findings.begin(), result.findings.end(), [](const Finding& finding) {
            return finding.message.find("hollow: fill") != std::string::npos;
        });
    };
    EXPECT_TRUE(told(empty));
    EXPECT_FALSE(told(full));
    const RunResult one = result_of("stages: [spherize.cover]\nbudget: {spheres: 6}\nlinks: {base: {hollow: fill}}\n");
    EXPECT_EQ(spheres_of_link(one, "base"), spheres_of_link(full, "base"));
}

TEST_F(RunLinks, ABlockHasNoInsideToFill) {
    const RunResult as_is = result_of(grid_12);
    const RunResult full = result_of(std::string(grid_12) + "hollow: fill\n");
    EXPECT_EQ(as_is.total.excess, full.total.excess);
    EXPECT_EQ(full.links[0].filled, 0);
}

/// A link and its mirror image get spheres that are mirror images, as many of them, from one search.
TEST_F(Run, MirroredLinksGetMirroredSpheres) {
    const auto side = [](const std::string& name, const std::string& sign) {
        return "<link name=\"" + name + "\"><collision><origin xyz=\"0.1 " + sign + "0.2 0\" rpy=\"" + sign +
               "0.3 0 0\"/><geometry><box size=\"0.3 0.1 0.05\"/></geometry></collision><collision><origin xyz=\"0.2 " +
               sign + "0.25 0.1\"/><geometry><cylinder radius=\"0.03\" length=\"0.2\"/></geometry></collision></link>" +
               "<joint name=\"to_" + name + "\" type=\"fixed\"><parent link=\"base\"/><child link=\"" + name +
               "\"/></joint>";
    };
    write("pair.urdf", "<robot name=\"pair\"><link name=\"base\"><collision><geometry><box size=\"0.2 0.2 0.2\"/>"
                       "</geometry></collision></link>" +
                           side("left", "") + side("right", "-") + "</robot>");
    for (const std::string elements : {"spherize.grid", "spherize.octree"}) {
        for (const std::size_t budget : {8u, 13u, 20u}) {
            Recipe pair =
                recipe("stages: [" + elements + "]\nbudget: {spheres: " + std::to_string(budget) + "}\n");
            pair.urdf = {"pair.urdf"};
            const RunResult result = run(pair, registry, options());
            EXPECT_TRUE(result.certified);
            auto read =
                test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf"));
            ASSERT_EQ(read["left"].size(), read["right"].size()) << elements << budget;
            for (std::size_t i = 0; i < read["left"].size(); ++i) {
                const Sphere &left = read["left"][i], &right = read["right"][i];
                EXPECT_LT(distance(left.center, {right.center.x, -right.center.y, right.center.z}), 2e-6);
                EXPECT_NEAR(left.radius, right.radius, 4e-6);
            }
            EXPECT_TRUE(std::any_of(result.findings.begin(), result.findings.end(), [](const Finding& finding) {
                return finding.link == "right" && finding.message.find("mirror image") != std::string::npos;
            }));
        }
    }
}

} // namespace
} // namespace foam
