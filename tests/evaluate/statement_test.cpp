// The sentences about a proof: they say no more than what is proved.
#include <foam/robot/proved_links.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace foam::test {
namespace {

using ::testing::ElementsAre;

/// A verdict on some links, of which others are left out.
ProvedLinks verdict_about(std::size_t proved, std::size_t all, Guarantee guarantee = Guarantee::outer) {
    ProvedLinks links;
    links.guarantee = guarantee;
    links.proved = proved;
    links.with_geometry = all;
    return links;
}

TEST(Statement, SaysOfHowManyLinksWhat) {
    EXPECT_EQ(statement_of(verdict_about(2, 2)),
              "proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids");
    EXPECT_EQ(statement_of(verdict_about(1, 1)), "proved: the collision geometry of 1 of 1 link lies inside its spheres, as a solid");
    EXPECT_EQ(statement_of(verdict_about(1, 2)),
              "proved in part: the collision geometry of 1 of 2 links lies inside their spheres, as a solid");
    EXPECT_EQ(statement_of(verdict_about(0, 2)), "not proved: the geometry may extend beyond the spheres");
    EXPECT_EQ(statement_of(verdict_about(0, 0)), "not proved: the geometry may extend beyond the spheres");
    EXPECT_EQ(statement_of(verdict_about(2, 2, Guarantee::inner)),
              "proved: the spheres of 2 of 2 links lie inside their collision geometry");
    EXPECT_EQ(statement_of(verdict_about(1, 2, Guarantee::inner)),
              "proved in part: the spheres of 1 of 2 links lie inside their collision geometry");
    EXPECT_EQ(statement_of(verdict_about(0, 1, Guarantee::inner)),
              "not proved: the spheres may extend beyond the geometry");
    EXPECT_EQ(statement_of(verdict_about(2, 2, Guarantee::fitted)), "nothing is proved (guarantee: fitted)");
    ProvedLinks other = verdict_about(2, 2);
    other.elements = "elements";
    other.geometry = CoveredGeometry::visual;
    other.float32 = true;
    EXPECT_EQ(statement_of(other),
              "proved: the visual geometry of 2 of 2 links lies inside their elements, as solids, also in single precision");
    other.guarantee = Guarantee::inner;
    EXPECT_EQ(statement_of(other),
              "proved: the elements of 2 of 2 links lie inside their visual geometry, also in single precision");
    other.proved = 0;
    EXPECT_EQ(statement_of(other), "not proved: the elements may extend beyond the geometry");
}

TEST(Statement, SaysWhichLinksAreCoveredAsSurfaces) {
    ProvedLinks links = verdict_about(3, 3);
    const std::string all = "proved: the collision geometry of 3 of 3 links lies inside their spheres, ";
    EXPECT_EQ(statement_of(links), all + "as solids");
    links.as_surface = {{"a", "its mesh is open"}};
    EXPECT_EQ(statement_of(links), all + "2 as solids, 1 as a surface; as a surface: a (its mesh is open)");
    EXPECT_EQ(verdict_of(links), "Proved: the collision geometry of 3 of 3 links lies inside their spheres, 2 as solids, 1 as "
                                 "a surface.\nAs a surface: a (its mesh is open).\n");
    links.as_surface.push_back({"b", "covers: surface"});
    EXPECT_EQ(as_what(links), "1 as a solid, 2 as surfaces");
    EXPECT_EQ(surfaces_text(links), "as a surface: a (its mesh is open), b (covers: surface)");
    links.as_surface.push_back({"c", "covers: surface"});
    EXPECT_EQ(as_what(links), "as surfaces");
    EXPECT_EQ(as_what(verdict_about(1, 1)), "as a solid");
    EXPECT_EQ(surfaces_text(verdict_about(1, 1)), "");
}

TEST(Statement, SaysHowMuchOfTheVolumeIsLeftOut) {
    ProvedLinks links = verdict_about(2, 2);
    links.as_surface = {{"a", "its mesh is open"}};
    links.missing = 0.25;
    EXPECT_EQ(statement_of(links), "proved: the collision geometry of 2 of 2 links lies inside their spheres, 1 as a solid, 1 as "
                                   "a surface; as a surface: a (its mesh is open); 25 % of the volume lies outside all spheres");
    links.missing = 0.00012;
    EXPECT_EQ(missing_text(links), "0.012 % of the volume lies outside all spheres");
    for (const double little : {0.00009, 1e-300}) {
        links.missing = little;
        EXPECT_EQ(missing_text(links), "less than 0.01 % of the volume lies outside all spheres");
    }
    links.missing = 0.0001;
    EXPECT_EQ(missing_text(links), "0.01 % of the volume lies outside all spheres");
    for (const double most : {0.996, 1.0}) {
        links.missing = most;
        EXPECT_EQ(missing_text(links), "100 % of the volume lies outside all spheres");
    }
    for (const double unknown : {std::nan(""), HUGE_VAL}) {
        links.missing = unknown;
        EXPECT_EQ(missing_text(links), "how much of the volume lies outside all spheres was not measured");
    }
    links.missing = 0;
    EXPECT_EQ(missing_text(links), "");
    links.missing = 0.5;
    links.guarantee = Guarantee::inner; // has nothing to do with it
    EXPECT_EQ(missing_text(links), "");
    links.guarantee = Guarantee::fitted;
    EXPECT_EQ(missing_text(links), "");
    EXPECT_EQ(verdict_of(links), "Nothing is proved (guarantee: fitted).\n");
}

TEST(Statement, NamesWhatIsLeftOut) {
    ProvedLinks links = verdict_about(1, 3);
    links.left_out = {{"a\n", "skip in the recipe"}, {"b", "the proof\tfails"}};
    const std::string names = "a\\x0a (skip in the recipe), b (the proof\\x09fails)";
    EXPECT_EQ(statement_of(links), "proved in part: the collision geometry of 1 of 3 links lies inside their spheres, as a solid; "
                                   "not part of the proof: " + names);
    EXPECT_EQ(omissions_of(links), "Not part of the proof: " + names + ".\n");
    links.guarantee = Guarantee::fitted;
    EXPECT_EQ(omissions_of(links), "Left out: " + names + ".\n");
    EXPECT_EQ(omissions_of(verdict_about(1, 1)), "");
    links = verdict_about(1, 1);
    links.visual_only = {"x"};
    EXPECT_EQ(omissions_of(links), "1 link has visual geometry only and no spheres: x.\n");
    links.visual_only = {"x", "y", "z"};
    EXPECT_EQ(omissions_of(links), "3 links have visual geometry only and no spheres: x, y, z.\n");
    links.visual_only.push_back("w\n");
    links.collision_only = {"v\n"};
    EXPECT_EQ(omissions_of(links), "4 links have visual geometry only and no spheres: x, y, z and 1 more.\n"
                                   "1 link has collision geometry only and no spheres: v\\x0a.\n");
}

TEST(Statement, LinksThatAreSeenAlone) {
    Robot robot;
    const GeometryElement shape{.origin = {}, .geometry = Element{}, .name = ""};
    robot.links = {{"both", {shape}, {shape}}, {"seen", {}, {shape}}, {"none", {}, {}}, {"felt", {shape}, {}}};
    EXPECT_THAT(visual_only_links(robot), ElementsAre("seen"));
}

TEST(Statement, AllIsMoreThanNone) {
    EXPECT_TRUE(verdict_about(2, 2).all());
    EXPECT_FALSE(verdict_about(1, 2).all());
    EXPECT_FALSE(verdict_about(0, 0).all());
}

} // namespace
} // namespace foam::test
