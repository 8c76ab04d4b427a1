// Which spheres go to which link, and what is said of those that go nowhere.
#include "evaluate/files.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* arm_text = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="mid"/>
  <link name="tip"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="a" type="fixed"><parent link="base"/><child link="mid"/></joint>
  <joint name="b" type="fixed"><parent link="mid"/><child link="tip"/></joint>
</robot>)";

class Match : public Files {
protected:
    Original original(const std::vector<std::string>& links = {}) const {
        return load_original(write("arm.urdf", arm_text), registry, {.links = links});
    }
    std::string refusal_of(const std::string& spheres, const Renames& renames = {}) const {
        try {
            match(original(), read(spheres), renames);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(Match, ByName) {
    const Original robot = original();
    ASSERT_EQ(robot.links.size(), 2u);
    const MatchedModel model = match(robot, read("tip 0 0 0 0.1\nbase 0 0 0 0.2\n"));
    EXPECT_THAT(model.elements, ElementsAre(Elements{{{}, 0.2}}, Elements{{{}, 0.1}}));
    EXPECT_THAT(model.notes, IsEmpty());
}

TEST_F(Match, NothingIsLeftOutSilently) {
    const MatchedModel model = match(original(), read("base 0 0 0 0.2\nmid 0 0 0 1\nmid 0 0 1 1\nother 0 0 0 1\n"));
    EXPECT_THAT(model.elements, ElementsAre(Elements{{{}, 0.2}}, Elements{}));
    EXPECT_THAT(model.notes, ElementsAre("link 'mid' has 2 spheres, but no geometry to judge them by",
                                         "1 sphere of link 'other' is ignored: arm.urdf has no such link",
                                         "1 of 2 links with collision geometry have no spheres: tip"));
}

TEST_F(Match, LinksThatOnlyCarrySpheresAreFolded) {
    // As MorphIt writes them: a fixed link for each sphere; here one hangs from the other, turned by a quarter.
    const MatchedModel model = match(original(), read(R"(<robot name="arm">
  <link name="base"/><link name="tip"/>
  <link name="tip_sphere1"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="tip_sphere2"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="a" type="revolute"><parent link="base"/><child link="tip"/><limit effort="1" velocity="1"/></joint>
  <joint name="b" type="fixed"><parent link="tip"/><child link="tip_sphere1"/><origin xyz="1 2 3"/></joint>
  <joint name="c" type="fixed"><parent link="tip_sphere1"/><child link="tip_sphere2"/>
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/></joint>
</robot>)"));
    ASSERT_EQ(model.elements.at(1).size(), 2u);
    EXPECT_EQ(model.elements[1].spheres()[0], (Sphere{{1, 2, 3}, 0.1}));
    EXPECT_NEAR(distance(model.elements[1].spheres()[1].center, {1, 2.5, 4}), 0, 1e-12);
    EXPECT_THAT(model.notes, ElementsAre("2 links that the robot lacks are taken with the link that they are fixed to",
                                         "1 of 2 links with collision geometry have no spheres: base"));
}

TEST_F(Match, RefusesAModelWithoutAnySphereSwitchedOn) {
    EXPECT_THAT(refusal_of("base 0 0 0 0\ntip 0 0 0 -1\n"),
                ::testing::EndsWith(": no sphere has a radius above 0; remedy: correct the file"));
}

TEST_F(Match, Renames) {
    const SphereFile file = read("my_base 0 0 0 0.2\n7 0 0 0 0.1\n");
    const MatchedModel model = match(original(), file, {{"my_", ""}, {"7", "tip"}});
    EXPECT_THAT(model.notes, IsEmpty());
    EXPECT_THAT(model.elements, ElementsAre(Elements{{{}, 0.2}}, Elements{{{}, 0.1}}));
}

TEST_F(Match, SpheresWithoutALink) {
    EXPECT_THAT(refusal_of("0 0 0 1\n"), HasSubstr("spheres: the spheres name no link, and "));
    EXPECT_THAT(refusal_of("0 0 0 1\n"), HasSubstr("arm.urdf has 2 links; remedy: --rename =LINK"));
    EXPECT_THAT(match(original(), read("0 0 0 1\n"), {{"", "tip"}}).elements,
                ElementsAre(IsEmpty(), Elements{{{}, 1}}));
    EXPECT_THAT(match(original({"tip"}), read("0 0 0 1\n")).elements, ElementsAre(Elements{{{}, 1}}));
}

TEST_F(Match, NoLinkInCommon) {
    EXPECT_THAT(refusal_of("a 0 0 0 1\nb 0 0 0 1\n"),
                HasSubstr("spheres: none of its links (a, b) is a link with collision geometry of "));
    EXPECT_THAT(refusal_of("a 0 0 0 1\n"),
                HasSubstr("arm.urdf (base, tip); remedy: --rename OLD=NEW if only the names differ"));
}

TEST_F(Match, AModelWithoutSpheres) {
    EXPECT_THAT(
        refusal_of("<robot name='r'><link name='base'/></robot>"),
        HasSubstr("spheres: it holds no spheres (URDF); remedy: the geometry comes first and its sphere model second; "
                  "`foam spherize` makes one"));
}

TEST_F(Match, AGlobOfNoLink) {
    try {
        original({"t*", "elbow"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("--keep 'elbow' matches no link of "));
    }
}

TEST_F(Match, EvaluationCountsLinksWithoutSpheres) {
    const Original robot = original();
    const MatchedModel model = match(robot, read("tip 0 0 0 0.2\n"));
    const Evaluation evaluation = evaluate(robot, model);
    EXPECT_EQ(evaluation.links[0].measures.spheres, 0u);
    EXPECT_EQ(evaluation.links[0].measures.covered, 0);
    EXPECT_NEAR(evaluation.links[0].measures.missing, 1, 1e-9);
    EXPECT_TRUE(std::isinf(evaluation.total.measures.gap));
    EXPECT_FALSE(evaluation.total.measures.certified);
    EXPECT_TRUE(evaluation.with_spheres.measures.certified);
    EXPECT_NEAR(evaluation.with_spheres.measures.excess, 7, 0.02);
    const std::vector<LinkProof> outer = prove(robot, model, Guarantee::outer);
    EXPECT_FALSE(outer[0].holds);
    EXPECT_TRUE(outer[1].holds);
}

TEST_F(Match, BothGuaranteesAreProved) {
    const Original robot = original({"base"});
    const auto proof = [&](const std::string& spheres, Guarantee guarantee) {
        return prove(robot, match(robot, read(spheres)), guarantee).at(0);
    };
    EXPECT_TRUE(proof("base 0 0 0 0.174\n", Guarantee::outer).holds);
    EXPECT_FALSE(proof("base 0 0 0 0.173\n", Guarantee::outer).holds);
    EXPECT_TRUE(proof("base 0 0 0 0.0999\n", Guarantee::inner).holds);
    const LinkProof sticks_out = proof("base 0 0 0 0.05\nbase 0.01 0 0 0.1\n", Guarantee::inner);
    EXPECT_FALSE(sticks_out.holds);
    EXPECT_EQ(sticks_out.sphere, 1u);
    EXPECT_NEAR(sticks_out.growth, 0.01, 1e-6);
    EXPECT_EQ(sticks_out.witness, (Vec3{0.01, 0, 0}));
    EXPECT_THROW(prove(robot, match(robot, read("base 0 0 0 1\n")), Guarantee::fitted), Error);
}

} // namespace
} // namespace foam::test
