// Triangles cut along bodies and between them: the parts tile the triangle, and each is where it is said to be.
#include "geometry/src/proof/body_cuts.hpp"
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using test::ball_about, test::box_between;
using Kind = Element::Kind;

namespace {

constexpr std::uint32_t most_halvings = 120;
constexpr std::size_t plenty = 10'000;

double area_of(const Corners& t) {
    return norm(cross(t.b - t.a, t.c - t.a)) / 2;
}
double area_of(std::span<const Vec3> polygon) {
    double area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
        area += area_of({polygon[0], polygon[k - 1], polygon[k]});
    }
    return area;
}

/// A right angle at the origin, in the plane z = 0.
const Corners triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

struct Cuts {
    std::vector<Element> elements;
    Bodies bodies;
    BodyCuts cuts;
    std::vector<std::uint32_t> all;

    explicit Cuts(const std::vector<Element>& e, std::uint32_t halvings = most_halvings)
        : elements(e), bodies({{}, elements}, {}, 5, most_halvings), cuts(bodies, halvings) {
        for (std::uint32_t i = 0; i < elements.size(); ++i) {
            all.push_back(i);
        }
    }
    bool cover(const Corners& t, double smallest = 1e-9, std::size_t most_pieces = plenty) {
        return cuts.cover(t, all, smallest, most_pieces);
    }
    /// The area of what is left of a triangle.
    double left_of(const Corners& t) {
        double area = 0;
        for (const std::vector<Vec3>& polygon : cuts.rest(t, all, plenty)) {
            area += area_of(polygon);
        }
        return area;
    }
};

TEST(BodyCuts, WhatIsLeftOfATriangleIsOutsideTheBoxes) {
    const double slack = 1e-12;
    const auto left = [&](const std::vector<Element>& elements, std::size_t most_pieces = plenty) {
        Cuts c(elements);
        double area = 0;
        for (const std::vector<Vec3>& polygon : c.cuts.rest(triangle, c.all, most_pieces)) {
            area += area_of(polygon);
            Vec3 middle{};
            for (const Vec3& p : polygon) {
                middle += p / static_cast<double>(polygon.size());
            }
            const bool inside = std::any_of(elements.begin(), elements.end(), [&](const Element& e) {
                return e.kind == Kind::box && holds(e, middle, slack);
            });
            EXPECT_FALSE(inside && most_pieces == plenty);
        }
        return area;
    };
    EXPECT_NEAR(left({box_between({1, 1, -1}, {2, 2, 1})}), 8 - 1, 1e-11);           // within, to an edge
    EXPECT_NEAR(left({box_between({-1, -1, -1}, {2, 3, 1})}), 8 - (6 - 0.5), 1e-11); // a corner
    EXPECT_NEAR(left({box_between({1, 1, -1}, {1.5, 2, 1}), box_between({1.25, 0.5, -1}, {2, 1.5, 1})}),
                8 - (0.5 + 0.75 - 0.125), 1e-11);
    EXPECT_NEAR(left({box_between({-9, -9, -1}, {9, 9, 1})}), 0, 0);
    EXPECT_NEAR(left({box_between({1, 1, 0.1}, {2, 2, 1})}), 8, 1e-11); // above it
    EXPECT_NEAR(left({ball_about({1, 1, 0}, 0.5)}), 8, 0);              // round ones are not cut out
    EXPECT_NEAR(left({ball_about({1, 1, 0}, 9)}), 0, 0);
    EXPECT_NEAR(left({}), 8, 0);
    for (const std::size_t pieces : {2u, 3u, 4u}) { // four are left around the first
        EXPECT_NEAR(left({box_between({1, 1, -1}, {1.5, 1.5, 1}), box_between({0.5, 0.5, -1}, {0.9, 0.9, 1})}, pieces),
                    8 - 0.25 - (pieces < 4 ? 0 : 0.16), 1e-11);
    }
}

TEST(BodyCuts, ABoxThatWouldTakeTooManyCutsIsNotCutOut) {
    // Its corner at (2, 1) takes two cuts, of which each counts as two halvings.
    const Element box = box_between({-1, 1, -1}, {2, 9, 1});
    for (const std::uint32_t halvings : {0u, 2u, 4u}) {
        Cuts c({box}, halvings);
        EXPECT_NEAR(c.left_of(triangle), halvings < 4 ? 8 : 8 - 4, 1e-11) << halvings;
        EXPECT_FALSE(c.cover(triangle));
    }
}

TEST(BodyCuts, EachProofCountsItsOwnPiecesAndEndsAtTheMost) {
    std::vector<Element> strips;
    for (int k = 0; k < 8; ++k) {
        strips.push_back(box_between({0.5 * k - 0.01, -1, -1}, {0.5 * k + 0.51, 9, 1}));
    }
    Cuts eight(strips);
    EXPECT_TRUE(eight.cover(triangle));
    const std::size_t pieces = eight.cuts.pieces();
    EXPECT_FALSE(eight.cover(triangle, 1e-9, pieces - 1));
    EXPECT_TRUE(eight.cover(triangle, 1e-9, pieces));
    EXPECT_EQ(eight.cuts.pieces(), pieces);
    EXPECT_GT(eight.cuts.most_cuts(), 0u);
    EXPECT_TRUE(eight.cover({{0.1, 0, 0}, {0.2, 0, 0}, {0.1, 1, 0}}));
    EXPECT_EQ(eight.cuts.pieces(), 0u);
    EXPECT_EQ(eight.cuts.most_cuts(), 0u);
}

TEST(BodyCuts, PolytopesThatOverlapByThreeSlacksCover) {
    // Erosion takes a slack of each, and the cut is an eighth of a slack deep in one of them.
    Random random(8);
    for (const double slacks : {1.8, 2.9}) {
        for (int k = 0; k < 40; ++k) {
            const double plane = random.uniform(0.5, 3);
            std::vector<Element> e{box_between({-1, -1, -1}, {plane, 9, 1}), box_between({plane, -1, -1}, {9, 9, 1})};
            const Bodies apart({{}, e}, {}, 5, most_halvings);
            const double overlap = slacks * std::max(apart.slack(0), apart.slack(1));
            e[0] = box_between({-1, -1, -1}, {plane + overlap, 9, 1});
            Cuts c(e);
            EXPECT_EQ(c.cover(triangle), slacks > 2) << plane;
        }
    }
}

TEST(BodyCuts, APolytopeIsCutOutWhereItsPolygonHasFewCornersAndNotAtAllElsewhere) {
    const Vec3 middle{1.2, 1.2, 0};
    const std::array<Vec3, 3> corner{triangle.a, triangle.b, triangle.c};
    for (int corners = 3; corners <= 20; ++corners) {
        for (std::size_t turn = 0; turn < 15; ++turn) { // which corner of the polygon comes first, and of the triangle
            std::vector<Vec3> points;
            for (int k = 0; k < corners; ++k) {
                const double angle = 2 * std::numbers::pi * k / corners + 0.45 * static_cast<double>(turn);
                for (const double z : {-1.0, 1.0}) {
                    points.push_back(middle + Vec3{std::cos(angle), std::sin(angle), z});
                }
            }
            const double area = std::sin(2 * std::numbers::pi / corners) * corners / 2;
            Cuts c({{.kind = Kind::hull, .hull = convex_hull(points)}});
            const Corners turned{corner[turn % 3], corner[(turn + 1) % 3], corner[(turn + 2) % 3]};
            const double left = c.left_of(turned);
            EXPECT_TRUE(std::abs(left - 8) < 1e-11 || std::abs(left - (8 - area)) < 1e-10) << corners << ' ' << left;
            EXPECT_TRUE(corners > 14 || left < 7.9) << corners;
            EXPECT_TRUE(corners <= 16 || left > 7.9) << corners;
            EXPECT_TRUE(corners > 14 || c.cuts.pieces() == static_cast<std::size_t>(corners)) << corners;
            EXPECT_TRUE(corners <= 16 || c.cuts.pieces() == 0) << corners;
            EXPECT_FALSE(c.cover(turned));
        }
    }
}

TEST(BodyCuts, MoreRoundBodiesAreDividedAtHalfTheLengthOfAnySize) {
    for (const double scale : {1e-3, 0.1, 1.0, 1e3}) {
        std::vector<Element> balls{ball_about({0.7, 0.7, 0}, 1.4), ball_about({3, 0.3, 0}, 1.4),
                                   ball_about({0.3, 3, 0}, 1.4), ball_about({1.8, 1.8, 0}, 1.2)};
        for (Element& ball : balls) {
            ball.pose.translation *= scale;
            ball.radius *= scale;
        }
        Cuts c(balls);
        const Corners t{triangle.a * scale, triangle.b * scale, triangle.c * scale};
        EXPECT_TRUE(c.cover(t, 1e-9 * scale)) << scale;
        EXPECT_GE(c.cuts.pieces(), 4u);
        EXPECT_LE(c.cuts.pieces(), 30u);
        EXPECT_FALSE(c.cover(t, 1e-9 * scale, 1)); // too many pieces
        EXPECT_FALSE(c.cover(t, 5.7 * scale));     // too small to be divided: the longest edge is √32
        EXPECT_TRUE(c.cover(t, 0.5 * scale));
        EXPECT_FALSE(Cuts(balls, 2).cover(t, 1e-9 * scale)); // a cut counts as two halvings, and more are needed
        balls.pop_back();
        EXPECT_FALSE(Cuts(balls).cover(t, 1e-9 * scale));
    }
}

TEST(BodyCuts, CutsBetweenTwoBodiesAreWhereBothNeedTheSame) {
    const Cuts c({ball_about({-1, 0, 0}, 0.5), ball_about({5, 0, 0}, 0.5), ball_about({0, 9, 0}, 0.5)});
    const std::vector<Corners> parts = c.cuts.between_nearest(triangle, std::span(c.all).first(2));
    double left = 0, right = 0;
    for (const Corners& part : parts) {
        for (const Vec3& p : {part.a, part.b, part.c}) {
            const Vec3 middle = (part.a + part.b + part.c) / 3;
            const bool first = c.bodies.growth(0, middle) < c.bodies.growth(1, middle);
            EXPECT_LE((first ? 1 : -1) * (c.bodies.growth(0, p) - c.bodies.growth(1, p)), 1e-11);
            (first ? left : right) += area_of(part) / 3;
        }
    }
    EXPECT_NEAR(left, 6, 1e-11); // they need the same where x is 2
    EXPECT_NEAR(right, 2, 1e-11);
    EXPECT_TRUE(c.cuts.between_nearest(triangle, std::span(c.all).first(1)).empty());
    // the last corner alone is nearest to another
    EXPECT_FALSE(c.cuts.between_nearest({{0, 0, 0}, {1, 0, 0}, {0, 8, 0}}, c.all).empty());
    EXPECT_FALSE(c.cuts.between_nearest({{0, 8, 0}, {0, 0, 0}, {1, 0, 0}}, c.all).empty());
    EXPECT_TRUE(c.cuts.between_nearest({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, c.all).empty());
}

TEST(BodyCuts, CutsBetweenRoundBodiesMeetTheEdgesWhereBothNeedTheSame) {
    Random random(6);
    int cut = 0, places = 0, exact = 0;
    for (int k = 0; k < 300; ++k) {
        const auto place = [&] { return Vec3{random.uniform(-1, 5), random.uniform(-1, 5), random.uniform(-3, 3)}; };
        const Cuts c({ball_about(place(), 0.1), k % 2 ? ball_about(place(), 0.4) : box_between({3, 3, -1}, {4, 4, 1})});
        const std::vector<Corners> parts = c.cuts.between_nearest(triangle, c.all);
        double area = 0;
        for (const Corners& part : parts) {
            area += area_of(part);
            int lower = 0, higher = 0;
            for (const Vec3& p : {part.a, part.b, part.c}) {
                const bool corner = p == triangle.a || p == triangle.b || p == triangle.c;
                const double more = c.bodies.growth(0, p) - c.bodies.growth(1, p);
                EXPECT_TRUE(corner || std::abs(more) < 1e-5) << k << ' ' << more;
                places += !corner;
                exact += !corner && std::abs(more) < 1e-11;
                EXPECT_TRUE(corner || p.x == 0 || p.y == 0 || std::abs(p.x + p.y - 4) < 1e-14);
                lower += corner && more < 0;
                higher += corner && more > 0;
            }
            EXPECT_TRUE(lower == 0 || higher == 0);
        }
        EXPECT_TRUE(parts.empty() || parts.size() == 3);
        EXPECT_TRUE(parts.empty() || std::abs(area - 8) < 1e-12) << area;
        int nearer = 0; // corners
        for (const Vec3& p : {triangle.a, triangle.b, triangle.c}) {
            nearer += c.bodies.growth(0, p) < c.bodies.growth(1, p);
        }
        EXPECT_EQ(parts.empty(), nearer == 0 || nearer == 3);
        cut += !parts.empty();
    }
    EXPECT_GT(cut, 50);
    EXPECT_GE(exact, 0.97 * places) << "eight steps are enough for nearly all" << places;
}

TEST(BodyCuts, OfAProofThatFailedNothingIsLeft) {
    Cuts c({box_between({1, 1, -1}, {1.5, 1.5, 1}), ball_about({0, 0, 0}, 0.5), ball_about({4, 0, 0}, 0.5),
            ball_about({0, 4, 0}, 0.5)});
    EXPECT_FALSE(c.cover(triangle)); // cut at the box, of which four sides are left
    EXPECT_TRUE(c.cover({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}));
}

TEST(BodyCuts, EightPairsThatHoldAllCornersAreTried) {
    Element left{.kind = Kind::capsule, .half = {0, 0, 9}, .radius = 2};
    left.pose = Pose::from_axis_angle({1, 0, 0}, std::numbers::pi / 2);
    Element right = left;
    right.pose.translation = {3.9, 0, 0};
    for (const std::size_t others : {7u, 8u}) { // balls at the corner that the first capsule does not hold
        std::vector<Element> elements(1 + others, ball_about({4, 0, 0}, 0.1));
        elements.front() = left;
        elements.push_back(right);
        Cuts c(elements);
        EXPECT_EQ(c.cover(triangle, 6), others < 8) << "it is too small to be halved";
        EXPECT_TRUE(others == 8 || c.cuts.pieces() == 2);
    }
}

TEST(BodyCuts, ATriangleWithACornerInNoBodyIsNotCut) {
    const std::array<Vec3, 3> corner{triangle.a, triangle.b, triangle.c};
    for (std::size_t turn = 0; turn < 3; ++turn) {
        Cuts c({ball_about(triangle.b, 3.5), ball_about(triangle.c, 3.5)});
        EXPECT_FALSE(c.cover({corner[turn], corner[(turn + 1) % 3], corner[(turn + 2) % 3]}));
        EXPECT_EQ(c.cuts.pieces(), 0u);
    }
}

TEST(BodyCuts, OneRoundBodyCoversWithoutACut) {
    Cuts c({ball_about({1, 1, 0}, 9), ball_about({1, 1, 0}, 0.1)});
    EXPECT_TRUE(c.cover(triangle));
    EXPECT_EQ(c.cuts.pieces(), 0u);
    EXPECT_EQ(c.cuts.most_cuts(), 0u);
}

TEST(BodyCuts, ABodyThatHoldsNothingIsNotCutOut) {
    // A pyramid that is thinner at its middle than its slack, and thicker elsewhere: its planes enclose a place, but it
    // holds nothing.
    const std::vector<Element> pyramid{
        {.kind = Kind::hull,
         .hull = convex_hull(std::vector<Vec3>{{0, -1, -1}, {0, 1, -1}, {0, -1, 1}, {0, 1, 1}, {12, 0, 0}})}};
    const double slack = Bodies({{}, pyramid}, {}, 5, most_halvings, 1e6).slack(0);
    const Bodies bodies({{}, pyramid}, {}, 5, most_halvings, 0.75e6 / slack);
    EXPECT_NEAR(bodies.slack(0), 0.75, 1e-6);
    const Vec3 enclosed{0.8, 0, 0};
    for (const Polytope::Face& plane : bodies.planes(0)) {
        EXPECT_LT(dot(plane.normal, enclosed - bodies.center(0)), plane.offset);
    }
    ASSERT_FALSE(bodies.holds(0, enclosed));
    BodyCuts cuts(bodies, most_halvings);
    const std::array<std::uint32_t, 1> all{0};
    for (const Corners& t : {Corners{{0, -1, 0}, {3, -1, 0}, {0, 2, 0}}, {{0.79, 0, 0}, {0.81, 0, 0}, {0.8, 0.01, 0}}}) {
        double area = 0;
        for (const std::vector<Vec3>& polygon : cuts.rest(t, all, plenty)) {
            area += area_of(polygon);
        }
        EXPECT_NEAR(area, area_of(t), 1e-15);
        EXPECT_FALSE(cuts.cover(t, all, 1e-9, plenty));
    }
}

TEST(BodyCuts, TrianglesThatAreAsLargeAsTheSmallestAreNotDivided) {
    // Cut once at half of its longest edge, which is 5, one part lies in a ball and the other in two.
    const Corners right{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    Cuts c({ball_about({0.5, 0.7, 0}, 1.5), ball_about({2, 0.9, 0}, 1.6), ball_about({0.5, 2.4, 0}, 1.8)});
    EXPECT_TRUE(c.cover(right, std::nextafter(5, 0)));
    EXPECT_EQ(c.cuts.pieces(), 4u);
    EXPECT_EQ(c.cuts.most_cuts(), 2u);
    EXPECT_FALSE(c.cover(right, 5));
}

TEST(BodyCuts, ACutMayGoThroughACorner) {
    const Vec3 middle{0, 0, 0}, left{-1, 1, 0}, right{1, 1, 0};
    for (const double y : {5.0, -1.0}) {
        const Cuts c({ball_about({-2, y, 0}, 0.5), ball_about({2, y, 0}, 0.5)});
        ASSERT_EQ(c.bodies.growth(0, middle), c.bodies.growth(1, middle));
        for (const Corners& t : {Corners{middle, left, right}, {left, right, middle}, {right, middle, left},
                                 {middle, right, left}, {right, left, middle}, {left, middle, right}}) {
            double of_left = 0, of_right = 0;
            for (const Corners& part : c.cuts.between_nearest(t, c.all)) {
                const double x[]{part.a.x, part.b.x, part.c.x};
                of_left += *std::max_element(x, x + 3) < 1e-11 ? area_of(part) : 0;
                of_right += *std::min_element(x, x + 3) > -1e-11 ? area_of(part) : 0;
            }
            EXPECT_NEAR(of_left, 0.5, 1e-11);
            EXPECT_NEAR(of_right, 0.5, 1e-11);
        }
    }
}

TEST(BodyCuts, WhichCornerComesFirstDoesNotMatter) {
    Random random(7);
    int several = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<Element> balls;
        for (const Vec3& place : {Vec3{0.7, 0.7, 0}, {3, 0.3, 0}, {0.3, 3, 0}, {1.8, 1.8, 0}, {1.5, 0.2, 0}, {0.2, 1.7, 0}}) {
            balls.push_back(ball_about(place + test::random_direction(random) * 0.3, random.uniform(0.8, 1.5)));
        }
        Cuts c(balls);
        if (c.cover(triangle)) {
            const std::size_t pieces = c.cuts.pieces();
            const std::uint32_t cuts = c.cuts.most_cuts();
            several += cuts > 2;
            for (const Corners& same : {Corners{triangle.a, triangle.c, triangle.b}, {triangle.b, triangle.c, triangle.a}}) {
                EXPECT_TRUE(c.cover(same));
                EXPECT_EQ(c.cuts.pieces(), pieces);
                EXPECT_EQ(c.cuts.most_cuts(), cuts) << "that of the piece with most, whether first or last";
            }
        }
    }
    EXPECT_GT(several, 20);
}

TEST(BodyCuts, APartKeepsItsTriangleAndCountsAsTwoHalvings) {
    const Piece part = BodyCuts::part_of({.corners = triangle, .beneath = {}, .triangle = 7, .level = 3}, triangle);
    EXPECT_EQ(part.triangle, 7u);
    EXPECT_EQ(part.level, 5u);
    EXPECT_FALSE(part.curved);
}

TEST(BodyCuts, RandomPolytopesCoverExactlyWhereNothingIsLeft) {
    Random random(4);
    int covered = 0;
    for (int k = 0; k < 200; ++k) {
        std::vector<Element> elements;
        for (int i = 0; i < 6; ++i) {
            std::vector<Vec3> points;
            for (int j = 0; j < 10; ++j) {
                points.push_back(Vec3{random.uniform(-0.5, 2), random.uniform(-0.5, 2), 0} +
                                 test::random_direction(random) * 4);
            }
            elements.push_back({.kind = Kind::hull, .hull = convex_hull(points)});
        }
        Cuts c(elements);
        const double area = c.left_of(triangle);
        EXPECT_EQ(c.cover(triangle), area == 0) << k << ' ' << area;
        covered += area == 0;
        // as many points of a grid are open as the area says
        int open = 0, all = 0;
        for (double x = 0.02; x < 4; x += 0.04) {
            for (double y = 0.02; x + y < 4; y += 0.04) {
                ++all;
                open += std::none_of(elements.begin(), elements.end(), [&](const Element& e) {
                    return holds(e, {x, y, 0});
                });
            }
        }
        EXPECT_NEAR(area, 8.0 * open / all, 0.1) << k;
    }
    EXPECT_GT(covered, 10);
    EXPECT_LT(covered, 190);
}

} // namespace
