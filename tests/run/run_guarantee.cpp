// What runs make of spheres so that the guarantee is kept.
#include "small_robot.hpp"
#include "support/read_spheres.hpp"

namespace foam {
namespace {

using ::testing::HasSubstr;

TEST_F(Run, GrowsWhatASpherizerLeavesOpen) {
    const RunResult result =
        run(recipe("stages: [spherize.misbehaving: {how: small, link: base}]\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.links[0].growth, 0.1);
    EXPECT_LT(result.links[1].growth, 1e-4);
}

TEST_F(Run, FittedSpheresNeitherClaimNorMissMuch) {
    const RunResult result =
        run(recipe("stages: [spherize.misbehaving: {how: small, link: base}, refine.fit]\nguarantee: fitted\n"),
            registry, options());
    EXPECT_FALSE(result.certified);
    const Measures& base = result.links[0].measures;
    EXPECT_GT(base.gap, 0.03);
    EXPECT_LT(base.covered, 0.9);
    EXPECT_GT(base.excess, 0.05);
    EXPECT_LT(base.excess + base.missing, 0.7);
}

TEST_F(Run, InnerShrinksWhatSticksOut) {
    const RunResult result =
        run(recipe("stages: [spherize.grid]\nbudget: {spheres: 12}\nguarantee: inner\n"), registry, options());
    EXPECT_TRUE(result.certified);
    EXPECT_GT(result.total.spheres, 1u);
    EXPECT_LT(result.total.missing, 0.9);
    EXPECT_NEAR(result.total.excess, 0, 1e-9);
    EXPECT_EQ(result.total.protrusion_max, 0);
    EXPECT_GT(result.total.gap, 0);
    const auto written = test::read_spheres(*registry.make<Writer>("write.urdf"), read_file(folder.path() / "out/two.urdf"));
    std::size_t count = 0;
    for (const auto& [link, spheres] : written) {
        count += spheres.size();
    }
    EXPECT_EQ(count, result.total.spheres);
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"guarantee\": \"inner\""));
    EXPECT_THAT(read_file(folder.path() / "out/manifest.json"), HasSubstr("\"certified\": true"));
}

TEST_F(Run, InnerSaysWhereNothingIsLeft) {
    const std::string stages = "stages: [spherize.misbehaving: {how: outside, link: tip}]\nguarantee: inner\n";
    EXPECT_EQ(failure(stages),
              "stage 'spherize.misbehaving', link 'tip', input 'cylinder': no sphere of this link lies inside its "
              "geometry; remedy: more spheres, another spherizer, or guarantee: outer or fitted; a surface without "
              "inside has no room");
    EXPECT_EQ(code, ErrorCode::geometry);
    const RunResult rest = run(recipe(stages + "on_error: skip\n"), registry, options());
    EXPECT_TRUE(rest.links_lost);
    EXPECT_FALSE(rest.certified) << "not of all";
    EXPECT_EQ(rest.proved.proved, 1u);
    EXPECT_EQ(rest.proved.with_geometry, 2u);
}

TEST_F(Run, OneSphereStandsInForOthersThatWouldClaimMore) {
    write("ball.urdf", R"(<robot name="two"><link name="base"><collision><geometry><sphere radius="0.1"/></geometry>
</collision><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link></robot>)");
    const RunResult result =
        run(recipe_of("name: two\nrobot: {urdf: ball.urdf}\nstages: [{spherize.octree: {depth: 1}}]\n"), registry,
            options());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.total.spheres, 1u);
    EXPECT_LE(result.total.excess, 0.02);
    EXPECT_THAT(warnings_of(result),
                ::testing::Contains(::testing::HasSubstr("one enclosing sphere is written, because")));
}

TEST_F(Run, ElementsThatOnlyTheirOwnFrameProvesAreRefused) {
    write("apart.urdf", R"(<robot name="apart"><link name="base">
<collision><geometry><box size="1e-5 2e-5 1e-5"/></geometry></collision>
<collision><origin xyz="2e6 0 0"/><geometry><box size="100 1000 100"/></geometry></collision></link></robot>)");
    const std::string text =
        "name: apart\nrobot: {urdf: apart.urdf}\nstages: [spherize.octree]\nbudget: {spheres: 4}\n";
    EXPECT_TRUE(run(recipe_of(text), registry, options()).certified);
    try {
        run(recipe_of(text + "per: collision\n"), registry, options("refused"));
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        EXPECT_STREQ(error.what(),
                     "link 'base': its collision elements are too small for the distance between them: the proof of "
                     "each in its own frame does not hold in the link's frame; remedy: per: link");
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "refused"));
}

} // namespace
} // namespace foam
