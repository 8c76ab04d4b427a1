// What is matched, judged and proved of robots and models that are made here: no reader takes part.
#include "made_models.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/judge/evaluate.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double around_cube = 0.1733; // a little more than half its diagonal

/// A robot of links with a cube each, and one without geometry called "bare".
Original cubes(const std::vector<std::string>& links, const std::string& left_out = "") {
    Original original = cubes_of_links(links, left_out);
    Robot robot = *original.robot;
    robot.links.push_back({.name = "bare", .collisions = {}, .visuals = {}});
    original.robot = std::make_shared<const Robot>(robot);
    return original;
}

SphereFile file_of(std::vector<LinkSpheres> links) {
    return test::file_of(std::move(links), "model.yaml");
}

Element box_element(const Vec3& half) {
    Element e;
    e.kind = Element::Kind::box;
    e.half = half;
    return e;
}

LinkSpheres one_ball(const std::string& link, double radius = around_cube, const Vec3& center = {}) {
    return {link, {{center, radius}}};
}

std::string refusal_of(const Original& original, SphereFile file, const Renames& renames = {}) {
    try {
        match(original, std::move(file), renames);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "";
}

TEST(JudgedLinks, ARenameOfTheWholeNameComesBeforeTheLongestPrefix) {
    const auto renamed = [](const std::string& name, const Renames& renames) {
        SphereFile file = file_of({one_ball(name)});
        rename_links(file, renames);
        return file.links[0].link;
    };
    for (const Renames& renames : {Renames{{"a", "x_"}, {"ab", "y_"}, {"abc", "whole"}, {"", "unnamed"}},
                                   Renames{{"", "unnamed"}, {"abc", "whole"}, {"ab", "y_"}, {"a", "x_"}}}) {
        EXPECT_EQ(renamed("abc", renames), "whole");
        EXPECT_EQ(renamed("abd", renames), "y_d");
        EXPECT_EQ(renamed("acd", renames), "x_cd");
        EXPECT_EQ(renamed("bca", renames), "bca") << "no prefix, and \"\" is none of other names";
        EXPECT_EQ(renamed("", renames), "unnamed");
    }
    EXPECT_EQ(renamed("abd", {{"ab", "first"}, {"ab", "second"}}), "firstd");
}

TEST(JudgedLinks, SpheresAndElementsGoToTheLinksOfTheirNames) {
    SphereFile file = file_of({one_ball("b", 0.3, {1, 2, 3}), {"a", {{}, {box_element({1, 2, 3})}}}});
    file.notes = {"of the reader"};
    const MatchedModel model = match(cubes({"a", "b"}), file);
    ASSERT_EQ(model.elements.size(), 2u);
    EXPECT_THAT(model.elements[0].spheres(), IsEmpty());
    EXPECT_THAT(model.elements[1].spheres(), ElementsAre(Sphere{{1, 2, 3}, 0.3}));
    EXPECT_THAT(std::vector<Element>(model.elements[0].shaped().begin(), model.elements[0].shaped().end()),
                ElementsAre(box_element({1, 2, 3})));
    EXPECT_TRUE(model.elements[1].are_spheres());
    EXPECT_THAT(model.notes, ElementsAre("of the reader"));
    EXPECT_THAT(match(cubes({"x_1", "b"}), file_of({one_ball("old1")}), {{"old", "x_"}}).elements[0].size(), 1u);
}

TEST(JudgedLinks, WhatALinkIsFixedToTakesItsElementsInItsFrame) {
    Pose up, turned = Pose::from_axis_angle({0, 0, 1}, std::numbers::pi / 2);
    up.translation = {0, 0, 1};
    turned.translation = {5, 0, 0};
    SphereFile file = file_of({{"finger", {{{{1, 0, 0}, 0.1}}, {box_element({1, 2, 3})}}}, one_ball("a", 0.2)});
    file.fixed_joints = {{"finger", {"palm", up}}, {"palm", {"a", turned}}};
    const MatchedModel one = match(cubes({"a"}), file);
    ASSERT_EQ(one.elements[0].size(), 3u);
    EXPECT_NEAR(distance(one.elements[0].spheres()[0].center, {5, 1, 1}), 0, 1e-15);
    EXPECT_EQ(one.elements[0][0].radius, 0.1);
    EXPECT_EQ(one.elements[0].spheres()[1], (Sphere{{}, 0.2}));
    ASSERT_EQ(one.elements[0].shaped().size(), 1u);
    EXPECT_NEAR(distance(one.elements[0].shaped()[0].pose * Vec3{1, 0, 0}, {5, 1, 1}), 0, 1e-15);
    EXPECT_THAT(one.notes, ElementsAre("1 link that the robot lacks is taken with the link that it is fixed to"));

    file.links.push_back(one_ball("palm"));
    EXPECT_THAT(match(cubes({"a"}), file).notes,
                ElementsAre("2 links that the robot lacks are taken with the link that they are fixed to"));
    EXPECT_EQ(match(cubes({"z"}), file, {{"a", "z"}}).elements[0].size(), 4u) << "by the new name of that link";

    file.fixed_joints["palm"].parent = "finger"; // in a circle
    EXPECT_THAT(match(cubes({"a"}), file).notes,
                ElementsAre("1 sphere, 1 box of link 'finger' are ignored: robot.urdf has no such link",
                            "1 sphere of link 'palm' is ignored: robot.urdf has no such link"));
}

TEST(JudgedLinks, WhatIsLeftOutIsSaid) {
    const MatchedModel model =
        match(cubes({"a", "b", "c"}), file_of({one_ball("b"), one_ball("bare"), one_ball("else"), {"empty", {}}}));
    EXPECT_THAT(model.notes, ElementsAre("link 'bare' has 1 sphere, but no geometry to judge them by",
                                         "1 sphere of link 'else' is ignored: robot.urdf has no such link",
                                         "2 of 3 links with collision geometry have no spheres: a, c"));
    EXPECT_THAT(match(cubes({"a", "b", "c"}), file_of({{"b", {{}, {box_element({1, 1, 1})}}}, one_ball("a")})).notes,
                ElementsAre("1 of 3 links with collision geometry have no spheres: c"));
}

TEST(JudgedLinks, SpheresWithoutALinkBelongToTheOnlyOne) {
    EXPECT_EQ(match(cubes({"a"}), file_of({one_ball("")})).elements[0].size(), 1u);
    EXPECT_THAT(refusal_of(cubes({"a", "b"}), file_of({one_ball("")})),
                HasSubstr("model.yaml: the spheres name no link, and folder/robot.urdf has 2 links; remedy: --rename"));
    EXPECT_THAT(refusal_of(cubes({}), file_of({one_ball("")})), HasSubstr("folder/robot.urdf has 0 links; remedy"));
    EXPECT_EQ(match(cubes({"a", "b"}), file_of({one_ball("")}), {{"", "b"}}).elements[1].size(), 1u);
    EXPECT_EQ(match(cubes({"a", "b"}), file_of({{"", {}}, one_ball("b")})).elements[1].size(), 1u);
}

TEST(JudgedLinks, AModelOfNothingIsRefused) {
    EXPECT_THAT(refusal_of(cubes({"a"}), file_of({})), HasSubstr("model.yaml: it holds no spheres (test); remedy"));
    EXPECT_THAT(refusal_of(cubes({"a"}), file_of({{"a", {}}, {"b", {}}})),
                HasSubstr("model.yaml: no sphere has a radius above 0"));
    EXPECT_THAT(refusal_of(cubes({"a", "b"}), file_of({one_ball("x"), one_ball("y"), {"z", {}}})),
                HasSubstr("model.yaml: none of its links (x, y, z) is a link with collision geometry of "
                          "folder/robot.urdf (a, b); remedy: --rename"));
}

TEST(JudgedLinks, FiguresAreThoseOfEachLinkAndTheirSums) {
    const Original original = cubes({"open", "covered", "none"});
    const MatchedModel model = match(original, file_of({one_ball("open", 0.15), one_ball("covered")}));
    const Evaluation evaluation = evaluate(original, model, 7);
    ASSERT_EQ(evaluation.links.size(), 3u);
    MeasureOptions options;
    options.seed = derive_seed(7, "open");
    const Measures open = measure(*original.links[0].solid, model.elements[0], options);
    EXPECT_EQ(evaluation.links[0].measures.covered, open.covered);
    ASSERT_GT(open.covered, 0.1);
    ASSERT_LT(open.covered, 0.95);
    const double points = static_cast<double>(options.surface_points) + 2;
    const double share = (open.covered * static_cast<double>(options.surface_points) + 1) / points;
    EXPECT_DOUBLE_EQ(evaluation.links[0].covered_error, std::sqrt(share * (1 - share) / points));
    EXPECT_EQ(evaluation.links[1].covered_error, 0) << "is proved";
    EXPECT_EQ(evaluation.links[2].covered_error, 0) << "nothing is covered for certain";
    EXPECT_EQ(evaluation.links[2].measures.spheres, 0u);
    const ProvedLinks verdict = proved_links(original, model, evaluation);
    EXPECT_EQ(verdict.proved, 1u);
    EXPECT_EQ(verdict.with_geometry, 3u);
    EXPECT_EQ(verdict.missing, evaluation.links[1].measures.missing) << "of the link that is proved";

    EXPECT_NEAR(evaluation.total.measures.covered, (open.covered + 1) / 3, 1e-12);
    EXPECT_NEAR(evaluation.total.covered_error, evaluation.links[0].covered_error / 3, 1e-15);
    EXPECT_EQ(evaluation.total.measures.spheres, 2u);
    EXPECT_NEAR(evaluation.with_spheres.measures.covered, (open.covered + 1) / 2, 1e-12);
    EXPECT_NEAR(evaluation.with_spheres.covered_error, evaluation.links[0].covered_error / 2, 1e-15);

    const MatchedModel both = match(original, file_of({one_ball("open", 0.15), one_ball("none", 0.15)}));
    const Evaluation two = evaluate(original, both, 7);
    EXPECT_NEAR(two.with_spheres.covered_error, std::hypot(two.links[0].covered_error, two.links[2].covered_error) / 2,
                1e-15);
}

TEST(JudgedLinks, ProofsOfCover) {
    const Original original = cubes({"open", "covered", "none", "boxed"});
    const MatchedModel model = match(
        original, file_of({one_ball("open", 0.15), one_ball("covered"), {"boxed", {{}, {box_element({1, 1, 1})}}}}));
    const std::vector<LinkProof> proofs = prove(original, model, Guarantee::outer);
    ASSERT_EQ(proofs.size(), 4u);
    const Certificate open = certify(*original.links[0].solid, model.elements[0]);
    EXPECT_FALSE(proofs[0].holds);
    EXPECT_EQ(proofs[0].growth, open.growth);
    EXPECT_NEAR(proofs[0].growth, 0.1 * std::sqrt(3) - 0.15, 1e-9);
    EXPECT_EQ(proofs[0].witness, open.witness);
    EXPECT_EQ(proofs[0].triangle, open.triangle);
    EXPECT_TRUE(proofs[1].holds);
    EXPECT_EQ(proofs[1].triangles, 12u);
    EXPECT_EQ(proofs[1].pieces, 12u);
    EXPECT_EQ(proofs[1].halvings, 0u);
    EXPECT_FALSE(proofs[2].holds);
    EXPECT_TRUE(proofs[3].holds);
    EXPECT_EQ(proofs[3].triangles, 12u);
    EXPECT_EQ(proofs[3].pieces, 12u);

    const MatchedModel small = match(original, file_of({{"boxed", {{}, {box_element({0.1, 0.1, 0.05})}}}}));
    const LinkProof refused = prove(original, small, Guarantee::outer)[3];
    const Certificate expected = certify(*original.links[3].solid, small.elements[3]);
    EXPECT_FALSE(refused.holds);
    EXPECT_NEAR(refused.growth, 0.05, 1e-9);
    EXPECT_EQ(refused.witness, expected.witness);
    EXPECT_EQ(refused.triangle, expected.triangle);
}

TEST(JudgedLinks, HalvingsAreThoseOfTheSmallestPiece) {
    const Original original = cubes({"a"});
    LinkSpheres balls{"a", {}};
    for (int k = 0; k < 8; ++k) {
        balls.elements.spheres().push_back({{k & 1 ? 0.05 : -0.05, k & 2 ? 0.05 : -0.05, k & 4 ? 0.05 : -0.05}, 0.1});
    }
    const LinkProof proof = prove(original, match(original, file_of({balls})), Guarantee::outer)[0];
    EXPECT_TRUE(proof.holds);
    EXPECT_GT(proof.pieces, 12u);
    const geometry::CoverProof expected = geometry::prove_cover(*original.links[0].solid, balls.elements.spheres());
    EXPECT_GT(proof.halvings, 0u);
    EXPECT_EQ(proof.halvings, expected.halvings);
    EXPECT_EQ(proof.triangles, 12u);
}

TEST(JudgedLinks, ProofsThatSpheresAreInside) {
    const Original original = cubes({"in", "out", "none"});
    const MatchedModel model =
        match(original, file_of({one_ball("in", 0.05), {"out", {{{}, 0.05}, {{0.07, 0.01, 0}, 0.05}}}}));
    const std::vector<LinkProof> proofs = prove(original, model, Guarantee::inner);
    EXPECT_TRUE(proofs[0].holds);
    EXPECT_FALSE(proofs[1].holds);
    EXPECT_EQ(proofs[1].sphere, 1u);
    EXPECT_NEAR(proofs[1].growth, 0.02, 1e-9);
    EXPECT_EQ(proofs[1].witness, (Vec3{0.07, 0.01, 0}));
    EXPECT_TRUE(proofs[2].holds) << "no sphere is outside";
}

TEST(JudgedLinks, WhatHasNoProofIsRefused) {
    const Original original = cubes({"a", "b"});
    const auto refusal = [&](const SphereFile& file, Guarantee guarantee) -> std::string {
        try {
            prove(original, match(original, file), guarantee);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(file_of({one_ball("a")}), Guarantee::fitted), HasSubstr("no proof of the guarantee fitted"));
    EXPECT_THAT(refusal(file_of({one_ball("a", 0.01), {"b", {{}, {box_element({1, 1, 1})}}}}), Guarantee::inner),
                HasSubstr("model.yaml: only spheres are proved to lie inside"));
    EXPECT_EQ(refusal(file_of({one_ball("a", 0.01)}), Guarantee::inner), "");
}

/// Proofs that hold or not, without their figures.
std::vector<LinkProof> proofs_of(std::initializer_list<bool> holds) {
    std::vector<LinkProof> proofs;
    for (const bool one : holds) {
        proofs.push_back({.holds = one});
    }
    return proofs;
}

MatchedModel no_spheres(const Original& original) {
    return {{}, std::vector<Elements>(original.links.size()), {}};
}

TEST(JudgedLinks, ProvedLinksAreCountedByTheRobot) {
    Original original = cubes({"first", "excluded", "open", "last"}, "excluded");
    original.geometry = CoveredGeometry::visual;
    original.collision_only = {"arm"};
    const ProvedLinks links = proved_links(original, no_spheres(original), proofs_of({true, false, true}), Guarantee::inner);
    EXPECT_EQ(links.guarantee, Guarantee::inner);
    EXPECT_EQ(links.geometry, CoveredGeometry::visual);
    EXPECT_THAT(links.collision_only, ElementsAre("arm"));
    EXPECT_EQ(links.with_geometry, 4u);
    EXPECT_EQ(links.proved, 2u);
    ASSERT_EQ(links.left_out.size(), 2u);
    EXPECT_EQ(links.left_out[0].link, "excluded");
    EXPECT_EQ(links.left_out[0].reason, "excluded by --keep or --skip");
    EXPECT_EQ(links.left_out[1].link, "open");
    EXPECT_EQ(links.left_out[1].reason, no_elements);
    EXPECT_FALSE(links.all());
    MatchedModel small = no_spheres(original);
    small.elements[1] = {{{0, 0, 0}, 0.01}};
    const ProvedLinks open = proved_links(original, small, proofs_of({true, false, true}), Guarantee::outer);
    EXPECT_EQ(open.left_out[1].reason, proof_fails);
    const Original two = cubes({"a", "b"}), first = cubes({"a", "b"}, "b");
    EXPECT_TRUE(proved_links(two, no_spheres(two), proofs_of({true, true}), Guarantee::outer).all());

    const ProvedLinks last = proved_links(first, no_spheres(first), proofs_of({true}), Guarantee::outer);
    EXPECT_EQ(last.proved, 1u);
    EXPECT_EQ(last.with_geometry, 2u);
    EXPECT_EQ(last.left_out.at(0).link, "b");
}

/// Plates over the faces of the cube, which leave 0.9 of each of its lengths open.
LinkSpheres shell_of(const std::string& link) {
    LinkSpheres shell{link, {}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-0.1, 0.1}) {
            Element plate = box_element({0.11, 0.11, 0.11});
            plate.half[axis] = 0.01;
            plate.pose.translation[axis] = side;
            shell.elements.add(plate);
        }
    }
    return shell;
}

/// Returns the original of whose links the surface alone is to be covered.
Original as_surfaces(Original original) {
    for (OriginalLink& link : original.links) {
        std::vector<Solid::Part> parts = link.solid->parts();
        for (Solid::Part& part : parts) {
            part.covers = Covers::surface;
        }
        link.solid = Solid::make(std::move(parts));
    }
    return original;
}

TEST(JudgedLinks, ACavityIsNotProved) {
    const Original solids = cubes({"shell", "full"}), surfaces = as_surfaces(solids);
    const MatchedModel model = match(solids, file_of({shell_of("shell"), one_ball("full")}));
    const std::vector<LinkProof> proofs = prove(solids, model, Guarantee::outer);
    EXPECT_FALSE(proofs[0].holds);
    EXPECT_TRUE(proofs[0].cavity);
    EXPECT_TRUE(solids.links[0].solid->contains(proofs[0].witness));
    EXPECT_GT(proofs[0].growth, 0);
    const ProvedLinks in_part = proved_links(solids, model, proofs, Guarantee::outer);
    EXPECT_EQ(in_part.proved, 1u);
    EXPECT_TRUE(in_part.as_surface.empty());
    EXPECT_EQ(in_part.missing, 0);
    const ProvedLinks links = proved_links(surfaces, model, prove(surfaces, model, Guarantee::outer), Guarantee::outer);
    EXPECT_EQ(links.proved, 2u);
    ASSERT_EQ(links.as_surface.size(), 2u);
    EXPECT_EQ(links.as_surface[0].link, "shell");
    EXPECT_EQ(links.as_surface[0].reason, "covers: surface");
}

TEST(JudgedLinks, WhatIsMissingIsOfTheProvedLinks) {
    const Original original = as_surfaces(cubes({"shell", "full", "open", "bald"}));
    const MatchedModel model = match(original, file_of({shell_of("shell"), one_ball("full"), one_ball("open", 0.01)}));
    const auto missing = [&](std::initializer_list<bool> proved) {
        return proved_links(original, model, proofs_of(proved), Guarantee::outer).missing;
    };
    const double open_share = 0.9 * 0.9 * 0.9;
    EXPECT_NEAR(missing({true, false, false, false}), open_share, 0.01);
    EXPECT_NEAR(missing({true, true, false, false}), open_share / 2, 0.01);
    EXPECT_NEAR(missing({false, true, false, false}), 0, 1e-6);
    EXPECT_EQ(missing({false, false, false, false}), 0);
    EXPECT_NEAR(missing({true, false, false, true}), open_share, 0.01) << "a link without elements has no share in it";
    const ProvedLinks links = proved_links(original, model, prove(original, model, Guarantee::outer), Guarantee::outer);
    EXPECT_EQ(links.proved, 2u);
    EXPECT_EQ(links.elements, "elements");
    EXPECT_NEAR(links.missing, open_share / 2, 0.01);
    EXPECT_EQ(links.as_surface.size(), 2u);
    const MatchedModel balls = match(original, file_of({one_ball("full")}));
    EXPECT_EQ(proved_links(original, balls, proofs_of({false, true, false, false}), Guarantee::outer).elements, "spheres");
}

TEST(JudgedLinks, LinksThatAreSeenOnlyAreNamed) {
    Original original = cubes({"a"});
    Robot robot = *original.robot;
    robot.links.push_back(
        {.name = "cover", .collisions = {}, .visuals = {{.origin = {}, .geometry = cube, .name = ""}}});
    original.robot = std::make_shared<const Robot>(robot);
    const ProvedLinks links = proved_links(original, no_spheres(original), proofs_of({true}), Guarantee::outer);
    EXPECT_THAT(links.visual_only, ElementsAre("cover"));
    EXPECT_EQ(links.with_geometry, 1u);
    EXPECT_TRUE(links.all());
}

} // namespace
} // namespace foam::test
