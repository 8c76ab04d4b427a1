// What is said when a stage of a run fails, and what is left behind.
#include "small_robot.hpp"

namespace foam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(Run, NamesStageLinkAndInputOfAFailure) {
    EXPECT_EQ(failure("stages: [spherize.misbehaving: {how: error, link: tip}]\n"),
              "stage 'spherize.misbehaving', link 'tip', input 'cylinder': this shape is not to my taste");
    EXPECT_EQ(code, ErrorCode::geometry);
    EXPECT_EQ(
        failure("stages: [spherize.misbehaving: {how: exception, link: tip}]\n"),
        "stage 'spherize.misbehaving', link 'tip', input 'cylinder': the stage threw an exception: index out of range");
    EXPECT_EQ(code, ErrorCode::plugin);
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: integer, link: tip}]\n"),
                HasSubstr("threw an object that is not a"));
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST_F(Run, EscapesNamesInAStagesOwnMessage) {
    write("tab.urdf", "<robot name=\"r\"><link name=\"a&#9;b\"><collision><geometry><box size=\"1 1 1\"/></geometry>"
                      "</collision></link></robot>");
    try {
        run(recipe_of("name: tab\nrobot: {urdf: tab.urdf}\n"
                      "stages: [spherize.misbehaving: {how: named, link: \"a\\tb\"}]\n"),
            registry, options());
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "stage 'spherize.misbehaving', link 'a\\x09b', input 'box': a\\x09b is not to my "
                                   "taste");
    }
}

TEST_F(Run, ABrokenContractIsFound) {
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: nothing, link: base}]\n"),
                HasSubstr("it returned no spheres"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: nan, link: base}]\n"), HasSubstr("not finite"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: parents, link: base}]\n"),
                HasSubstr("parent index of level 1"));
    EXPECT_THAT(failure("stages: [spherize.misbehaving: {how: many, link: base}]\nbudget: {spheres: 4}\n"),
                HasSubstr("returned 1000 spheres where at most 1 were requested"));
}

TEST_F(Run, ALostLinkIsOnlyLostOnRequest) {
    const std::string chain = "stages: [spherize.misbehaving: {how: error, link: tip}]\n";
    const RunResult skipped = run(recipe(chain + "on_error: skip\n"), registry, options());
    EXPECT_TRUE(skipped.links_lost);
    EXPECT_THAT(skipped.links[1].error, HasSubstr("not to my taste"));
    EXPECT_THAT(read_file(folder.path() / "out/two.urdf"), HasSubstr("<cylinder"));

    const RunResult fallback = run(recipe(chain + "on_error: fallback\n"), registry, options());
    EXPECT_FALSE(fallback.links_lost);
    EXPECT_TRUE(fallback.certified);
    EXPECT_EQ(fallback.links[1].measures.spheres, 1u);
    EXPECT_THAT(fallback.findings, ::testing::Contains(::testing::Field(
                                       &Finding::message, HasSubstr("one enclosing sphere replaces the link"))));
}

TEST_F(Run, NoSphereStandsInForGeometryThatCannotBeProved) {
    write("huge.urdf",
          "<robot name=\"r\"><link name=\"base\"><collision><geometry><box size=\"1 1 1\"/></geometry>"
          "</collision></link><link name=\"far\"><collision><geometry><box size=\"1e12 1 1\"/></geometry>"
          "</collision></link><joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"far\"/>"
          "</joint></robot>");
    const RunResult result = run(recipe_of("name: huge\nrobot: {urdf: huge.urdf}\nstages: [spherize.grid]\n"
                                           "on_error: fallback\n"),
                                 registry, options());
    EXPECT_TRUE(result.links_lost);
    EXPECT_THAT(result.links[1].error, HasSubstr("its size is 1e+12 m"));
    EXPECT_EQ(result.model.groups.size(), 1u);
}

TEST_F(Run, NoInputThatExists) {
    const auto result =
        parse_recipe("foam: 1\nname: x\nrobot: {urdf: [package://no_such/a.urdf, b.urdf]}\nstages: [spherize.grid]\n",
                     folder.path() / "x.yaml", registry);
    ASSERT_TRUE(result.ok());
    try {
        run(result.recipes.at(0), registry, options());
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_THAT(error.what(), HasSubstr("none of the inputs [package://no_such/a.urdf, b.urdf] exists"));
        EXPECT_THAT(error.what(), HasSubstr((folder.path() / "b.urdf").string()));
        EXPECT_THAT(error.what(), HasSubstr("remedy"));
    }
}

} // namespace
} // namespace foam
