// Triangles across several elements: what proves them, and in how many pieces.
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

#include <optional>

using namespace foam;
using test::ball_about, test::box_between;
using Kind = Element::Kind;

namespace {

/// A right angle at the origin, in the plane z = 0.
const Mesh right_angle = test::triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

/// Returns the number of pieces into which the proof that elements cover a mesh cuts it; nothing if there is none. One
/// is a box far away: spheres alone have a proof of their own.
std::optional<std::size_t> pieces_of(const Mesh& mesh, std::vector<Element> elements) {
    elements.push_back(box_between({-0.1, -0.1, 99}, {0.1, 0.1, 100}));
    const auto solid = Solid::make(mesh);
    if (!covers(*solid, Elements(elements))) {
        return {};
    }
    return certify(*solid, Elements(elements)).pieces - mesh.triangles.size();
}

TEST(TrianglesAcross, PolytopesThatOverlapCoverInAPieceEachAndTheSidesOfTheRest) {
    EXPECT_EQ(pieces_of(right_angle, {box_between({-1, -1, -1}, {9, 9, 1})}), 0u);
    const Element right = box_between({1, -1, -1}, {9, 9, 1});
    for (const double overlap : {1.0, 1e-3, 1e-9, 1e-11}) {
        EXPECT_EQ(pieces_of(right_angle, {box_between({-1, -1, -1}, {1 + overlap, 9, 1}), right}), 1u) << overlap;
        EXPECT_FALSE(pieces_of(right_angle, {box_between({-1, -1, -1}, {1 - overlap, 9, 1}), right})) << overlap;
    }
    std::vector<Element> strips;
    for (int k = 0; k < 8; ++k) {
        strips.push_back(box_between({0.5 * k - 0.01, -1, -1}, {0.5 * k + 0.51, 9, 1}));
    }
    ASSERT_TRUE(pieces_of(right_angle, strips));
    EXPECT_LE(*pieces_of(right_angle, strips), 14u);
    EXPECT_EQ(pieces_of(test::triangle({0.1, 0, 0}, {0.2, 0, 0}, {0.1, 1, 0}), strips), 0u);
    strips.erase(strips.begin() + 3);
    EXPECT_FALSE(pieces_of(right_angle, strips));
}

TEST(TrianglesAcross, TwoRoundElementsThatHoldTheEdgesAreToldApartByOneCut) {
    Element left{.kind = Kind::capsule, .half = {0, 0, 9}, .radius = 2};
    left.pose = Pose::from_axis_angle({1, 0, 0}, std::numbers::pi / 2);
    Element right = left;
    for (const double overlap : {1.0, 1e-3, 1e-9, 1e-11}) {
        right.pose.translation = {4 - overlap, 0, 0};
        EXPECT_EQ(pieces_of(right_angle, {left, right}), 2u) << overlap;
        // another that holds a corner is tried before
        EXPECT_EQ(pieces_of(right_angle, {left, ball_about({4, 0, 0}, 0.1), right}), 2u) << overlap;
        right.pose.translation = {4 + overlap, 0, 0};
        EXPECT_FALSE(pieces_of(right_angle, {left, right})) << overlap;
    }
}

TEST(TrianglesAcross, TheCutBetweenTwoBallsMeetsASlantedEdgeWhereTheyHardlyOverlap) {
    const Mesh slanted =
        test::triangle({0, 0, 0}, {4, 0, 0}, {0, 2, 0}); // its long edge is equally deep in both at (2, 1)
    for (const double overlap : {1e-3, 1e-6, 1e-9}) {
        const double radius = std::sqrt(5.0) + overlap;
        const Element right = ball_about({4, 0, 0}, radius);
        EXPECT_EQ(pieces_of(slanted, {ball_about({0, 0, 0}, radius), right}), 2u) << overlap;
        EXPECT_FALSE(pieces_of(slanted, {ball_about({0, 0, 0}, radius - 2 * overlap), right})) << overlap;
    }
}

} // namespace
