// Planes that the spheres of a link keep off, whatever the spherizer: none reaches farther beyond them than the recipe
// says, and there are no gaps. Judged on the file that was written.
#include "all_spherizers.hpp"
#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/refine.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using namespace foam;
using namespace foam::test;
using Json = nlohmann::json;

/// A foot: a plate that lies on z = 0 and a post on it, not along the link's axes.
class Clip : public RunTest {
protected:
    Clip() {
        write("foot.urdf", R"(<robot name="foot"><link name="foot">
                    <collision><origin xyz="0 0 0.01" rpy="0 0 0.4"/><geometry><box size="0.2 0.14 0.02"/></geometry>
                    </collision>
                    <collision><origin xyz="0.02 0 0.08" rpy="0.3 0 0"/><geometry><box size="0.06 0.06 0.1"/></geometry>
                    </collision>
                  </link></robot>)");
    }

    RunResult run_with(const std::string& spherizer, const std::string& rest) {
        return run(recipe_of("name: foot\nrobot: {urdf: foot.urdf}\nstages: [" + spherizer +
                             ", refine.fit, refine.clip]\n" + rest + "\noutputs: [write.urdf: {file: foot.urdf}]\n"),
                   registry, options());
    }
    std::vector<Sphere> written() const { return spheres_in("out/foot.urdf").at("foot"); }
    Json manifest() const { return Json::parse(text_of("out/manifest.json")); }
};

class EverySpherizer : public Clip, public testing::WithParamInterface<std::string> {};

TEST_P(EverySpherizer, KeepsOffThePlane) {
    const RunResult result =
        run_with(GetParam(), "budget: {spheres: 24}\nlinks: {foot: {clip: [{normal: [0, 0, -1], reach: 0.006}]}}");
    EXPECT_TRUE(result.certified);
    EXPECT_TRUE(result.findings.empty() || result.findings[0].severity == Severity::info);
    EXPECT_LE(written().size(), 24u);
    for (const Sphere& sphere : written()) {
        EXPECT_GE(sphere.center.z - sphere.radius, -0.006);
    }
    EXPECT_LT(result.total.excess, 6);
}

INSTANTIATE_TEST_SUITE_P(Spherizers, EverySpherizer, testing::ValuesIn(spherizer_names()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

TEST_F(Clip, ObliquePlanesAndSeveralOfThem) {
    // Below the plate, and along one of its corners, turned by 0.4 rad.
    const RunResult result = run_with(
        "spherize.grid", "budget: {spheres: 24}\nlinks:\n  foot:\n    clip:\n      - {normal: [0, 0, -2], reach: "
                         "0.008}\n      - {normal: [0.5, 0.6, -0.3], offset: 0.12, reach: 0.03}\n");
    EXPECT_TRUE(result.certified);
    const ClipPlane oblique{{0.5, 0.6, -0.3}, 0.12, 0.03};
    for (const Sphere& sphere : written()) {
        EXPECT_GE(sphere.center.z - sphere.radius, -0.008);
        EXPECT_LE(reach_beyond(oblique, sphere), 0.03);
    }
    const Json planes = manifest()["links"][0]["clip"];
    ASSERT_EQ(planes.size(), 2u);
    EXPECT_EQ(planes[0]["normal"], Json({0, 0, -2}));
    EXPECT_EQ(planes[1]["offset_m"], 0.12);
    EXPECT_EQ(planes[1]["reach_m"], 0.03);
    EXPECT_DOUBLE_EQ(planes[1]["reached_m"], reach_beyond(oblique, written()));
    EXPECT_EQ(planes[0]["kept"], true);
    EXPECT_NE(text_of("out/report.html").find("mm beyond the plane with normal [0, 0, -2] at 0.000 mm"),
              std::string::npos);
}

TEST_F(Clip, ElementsOfALinkHaveItsPlanes) {
    const RunResult result = run_with("spherize.grid", "per: collision\nbudget: {spheres: 30}\nlinks: {foot: {clip: "
                                                       "[{normal: [0, 0, -1], reach: 0.008}]}}");
    EXPECT_TRUE(result.certified);
    for (const Sphere& sphere : written()) {
        EXPECT_GE(sphere.center.z - sphere.radius, -0.008);
    }
}

TEST_F(Clip, APlaneThatNoSphereReachesChangesNothing) {
    run_with("spherize.octree", "");
    const std::vector<Sphere> before = written();
    const RunResult result = run_with("spherize.octree", "links: {foot: {clip: [{normal: [0, 0, -1], reach: 2}]}}");
    EXPECT_EQ(written(), before);
    EXPECT_LT(result.links[0].clip.at(0).reached, 0.5);
}

TEST_F(Clip, SpheresThatAreFittedOnlyAreShaved) {
    const RunResult result = run_with(
        "spherize.grid",
        "guarantee: fitted\nbudget: {spheres: 12}\nlinks: {foot: {clip: [{normal: [0, 0, -1], reach: 0.002}]}}");
    for (const Sphere& sphere : written()) {
        EXPECT_GE(sphere.center.z - sphere.radius, -0.002);
    }
    EXPECT_TRUE(result.links[0].clip.at(0).kept());
}

TEST_F(Clip, GeometryBeyondThePlaneIsAnError) {
    try {
        run_with("spherize.grid", "budget: {spheres: 12}\nlinks: {foot: {clip: [{normal: [0, 0, -1], offset: -0.01, "
                                  "reach: 0.004}]}}");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "stage 'geometry', link 'foot', input 'box': the geometry itself reaches 0.01 m beyond plane 1 of "
                     "'clip' (normal [0, 0, -1], offset -0.01 m), and spheres may reach 0.004 m beyond it; remedy: "
                     "raise the plane's offset, or its reach to more than 0.01");
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(Clip, WhatSoFewSpheresCannotKeepIsAWarning) {
    // Between two planes that leave 144 mm, one sphere cannot hold a plate of 20 cm.
    const RunResult result = run_with("spherize.grid", R"(budget: {spheres: 1}
links: {foot: {clip: [{normal: [0, 0, -1], reach: 0.002}, {normal: [0, 0, 1], offset: 0.14, reach: 0.002}]}})");
    EXPECT_TRUE(result.certified);
    std::size_t not_kept = 0;
    for (const PlaneReach& plane : result.links[0].clip) {
        not_kept += !plane.kept();
    }
    ASSERT_GE(not_kept, 1u);
    ASSERT_EQ(result.findings.size(), not_kept);
    EXPECT_EQ(result.findings[0].link, "foot");
    EXPECT_EQ(result.findings[0].severity, Severity::warning);
    EXPECT_THAT(result.findings[0].message,
                testing::ContainsRegex(
                    "^its spheres reach 0\\.[0-9]+ m beyond plane [12] of 'clip' \\(normal .*\\), "
                    "reach allows 0\\.002 m; remedy: refine.clip after the spherizer, more spheres for the robot or "
                    "for this link, or a larger reach$"));
}

TEST(CoveringWithin, EverySampleSolidFromEverySide) {
    for (const auto& [name, make] : sample::solids()) {
        const auto solid = make();
        for (const Vec3& normal : {Vec3{0, 0, -1}, Vec3{-1, 2, 0.7}}) {
            ClipPlane plane{normal, 0, 0.04 * solid->bounds().diagonal()};
            for (const Vec3& v : solid->surface().vertices) {
                plane.offset = std::max(plane.offset, dot(normalized(normal), v));
            }
            SCOPED_TRACE(name + ", " + text_of(plane));
            const std::vector<Sphere> start{minimum_enclosing_sphere(solid->surface().vertices)};
            const std::vector<Sphere> spheres = covering_within(*solid, start, 12, {plane}, 0);
            EXPECT_LE(spheres.size(), 12u);
            EXPECT_TRUE(certify(*solid, spheres).holds);
            EXPECT_LT(reach_beyond(plane, spheres), plane.reach);
        }
    }
}

TEST(Shaved, IsTheLargestSphereInWhatIsLeft) {
    const auto box = Solid::make({{nullptr, Element::box({1, 1, 1}), {}}});
    const std::vector<Sphere> spheres =
        shrunk_within(*box, {{{0, 0, 0}, 1}, {{0, 0, -3}, 1}}, {{{0, 0, -5}, 0.5, 0.1}});
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_NEAR(spheres[0].radius, 0.8, 1e-4);
    EXPECT_NEAR(spheres[0].center.z, 0.2, 1e-4);
}

TEST(ClipPlane, IsTheSameFromAnotherFrame) {
    const Pose pose = Pose::from_xyz_rpy({0.1, -2, 3}, {0.4, 1, -0.7});
    const ClipPlane plane{{1, -2, 0.5}, 0.3, 0.01};
    const Sphere there{{0.2, 0.5, -0.1}, 0.4}, here{pose * there.center, 0.4};
    EXPECT_NEAR(reach_beyond(seen_from(plane, pose), there), reach_beyond(plane, here), 1e-12);
    EXPECT_EQ(seen_from(plane, Pose{}), plane);
}

} // namespace
