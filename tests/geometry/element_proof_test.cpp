// Parts of the proof for elements: what is contained by its lengths, which triangles are open, and where the gap is.
#include "geometry/src/proof/element_proof.hpp"
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/geometry/internal/proof.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using Kind = Element::Kind;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Element element_with(Kind kind, const Vec3& half, double radius) {
    Element e{.kind = kind, .half = half, .radius = radius};
    e.pose.translation = {1, 2, 3};
    return e;
}

bool contains(const Element& e, const Element& p) {
    Pose pose;
    pose.translation = {1, 2, 3};
    return contains_by_lengths(e, {nullptr, p, pose});
}

/// Expects that the element contains the primitive, and not if any of these lengths is a last bit smaller.
void expect_just(Element e, const Element& p, const std::vector<double Element::*>& radii,
                 const std::vector<int>& halves) {
    EXPECT_TRUE(contains(e, p));
    const auto expect_not = [&](double& length) {
        const double before = length;
        length = std::nextafter(length, 0);
        EXPECT_FALSE(contains(e, p)) << to_string(e.kind);
        length = 2 * before;
        EXPECT_TRUE(contains(e, p)) << to_string(e.kind);
        length = before;
    };
    for (double Element::*radius : radii) {
        expect_not(e.*radius);
    }
    for (const int axis : halves) {
        expect_not(e.half[axis]);
    }
    e.pose.translation.x = std::nextafter(1, 2);
    EXPECT_FALSE(contains(e, p)) << to_string(e.kind);
}

TEST(ContainsByLengths, PrimitivesInElementsWithRoomForThem) {
    const Element ball = Element::sphere(0.3), capsule = Element::capsule(0.3, 1),
        cylinder = Element::cylinder(0.3, 1), box = Element::box({1, 2, 3});
    expect_just(element_with(Kind::sphere, {}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::capsule, {0, 0, 0.1}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::swept_box, {0.1, 0.1, 0.1}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::cylinder, {0, 0, 0.3}, 0.3), ball, {&Element::radius}, {2});
    expect_just(element_with(Kind::box, {0.3, 0.3, 0.3}, 0), ball, {}, {0, 1, 2});
    expect_just(element_with(Kind::swept_box, {0.3, 0.3, 0.3}, 0.1), ball, {}, {0, 1, 2});
    expect_just(element_with(Kind::capsule, {0, 0, 0.5}, 0.3), capsule, {&Element::radius}, {2});
    expect_just(element_with(Kind::swept_box, {0.1, 0.1, 0.5}, 0.3), capsule, {&Element::radius}, {2});
    expect_just(element_with(Kind::cylinder, {0, 0, 0.5}, 0.3), cylinder, {&Element::radius}, {2});
    expect_just(element_with(Kind::capsule, {0, 0, 0.5}, 0.3), cylinder, {&Element::radius}, {2});
    expect_just(element_with(Kind::box, {0.5, 1, 1.5}, 0), box, {}, {0, 1, 2});
    expect_just(element_with(Kind::swept_box, {0.5, 1, 1.5}, 0.1), box, {}, {0, 1, 2});
}

TEST(ContainsByLengths, OthersAreNotCompared) {
    const Element ball = Element::sphere(0.3), capsule = Element::capsule(0.3, 1),
        cylinder = Element::cylinder(0.3, 1), box = Element::box({1, 1, 1});
    Element hull = element_with(Kind::hull, {}, 0);
    hull.hull = convex_hull(test::box({-9, -9, -9}, {9, 9, 9}).vertices);
    for (const Element& p : {ball, capsule, cylinder, box}) {
        EXPECT_FALSE(contains(hull, p));
        EXPECT_FALSE(contains(element_with(Kind::box, {-9, 9, 9}, 0), p));
    }
    hull.hull = convex_hull(test::box({1, 1, 1}, {2, 2, 2}).vertices);
    EXPECT_FALSE(contains(hull, Element::sphere(0))) << "the middle is beside it";
    EXPECT_FALSE(contains(element_with(Kind::box, {9, 9, 9}, 0), capsule));
    EXPECT_FALSE(contains(element_with(Kind::cylinder, {0, 0, 9}, 9), capsule));
    EXPECT_FALSE(contains(element_with(Kind::sphere, {}, 9), capsule));
    EXPECT_FALSE(contains(element_with(Kind::box, {9, 9, 9}, 0), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::sphere, {}, 9), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::swept_box, {9, 9, 9}, 9), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::cylinder, {0, 0, 9}, 9), box));
    EXPECT_FALSE(contains(element_with(Kind::capsule, {0, 0, 9}, 9), box));
    const Element ball_around = element_with(Kind::sphere, {}, 9);
    EXPECT_FALSE(contains_by_lengths(
        ball_around, {std::make_shared<const Mesh>(test::ball({}, 1, 4)), std::nullopt, ball_around.pose}));
}

/// Boxes, balls and capsules about random places of a surface.
std::vector<Element> strewn(const Mesh& mesh, int count, double size, Random& random) {
    std::vector<Element> elements;
    for (int k = 0; k < count; ++k) {
        Element e{.kind = std::array{Kind::box, Kind::sphere, Kind::capsule}[static_cast<std::size_t>(k % 3)]};
        e.pose = test::random_pose(random, 0);
        e.pose.translation = mesh.vertices[random.below(mesh.vertices.size())];
        e.radius = e.kind == Kind::box ? 0 : size;
        e.half = e.kind == Kind::box ? Vec3{size, size, size} : e.kind == Kind::capsule ? Vec3{0, 0, size} : Vec3{};
        elements.push_back(e);
    }
    return elements;
}

TEST(OpenTriangles, AreThoseThatNoElementContains) {
    Random random(1);
    for (int k = 0; k < 20; ++k) {
        const auto solid = Solid::make(test::ball({1, 2, 3}, 1, 8));
        const std::vector<Element> elements = strewn(solid->surface(), 12, 0.5, random);
        const Balls pieces(*solid, {}, 120);
        const Bodies bodies({{}, elements}, solid->bounds().center(), pieces.extent(), 120);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t t = 0; t < solid->surface().triangles.size(); ++t) {
            const auto& [a, b, c] = solid->surface().triangles[t];
            const auto& v = solid->surface().vertices;
            if (std::none_of(elements.begin(), elements.end(),
                             [&](const Element& e) { return holds(e, v[a]) && holds(e, v[b]) && holds(e, v[c]); })) {
                expected.push_back(t);
            }
        }
        EXPECT_EQ(OpenTriangles(*solid, {{}, elements}, pieces, bodies).triangles(), expected);
        EXPECT_FALSE(expected.empty());
        const Certificate certificate = certify(*solid, Elements(elements));
        EXPECT_GE(certificate.pieces, solid->surface().triangles.size());
    }
}

TEST(ElementCertificate, APartThatIsContainedProvesNothingOfOthers) {
    const Element ball = Element::sphere(0.3), cylinder = Element::cylinder(0.3, 1);
    Pose right;
    right.translation = {2, 0, 0};
    for (const Element& p : {ball, cylinder}) {
        Element left{.kind = Kind::cylinder, .half = {0, 0, 0.5}, .radius = 0.3}, both = left;
        both.pose = right;
        const std::vector<Element> one{left}, two{left, both};
        const auto solid = Solid::make({{nullptr, p, {}}, {nullptr, p, right}});
        EXPECT_FALSE(covers(*solid, Elements(one))) << to_string(p.kind);
        EXPECT_TRUE(covers(*solid, Elements(two))) << to_string(p.kind);
        const auto reversed = Solid::make({{nullptr, p, right}, {nullptr, p, {}}});
        EXPECT_FALSE(covers(*reversed, Elements(one))) << to_string(p.kind);
        EXPECT_TRUE(covers(*reversed, Elements(two))) << to_string(p.kind);
    }
}

TEST(ElementCertificate, ASmallTriangleFarAwayIsLookedAtOnce) {
    const auto solid = Solid::make(Mesh{{{3, 0, 0}, {3, 1e-4, 0}, {3, 0, 1e-4}}, {{0, 1, 2}}});
    const Element box{.kind = Kind::box, .half = {1, 1, 1}};
    const Certificate certificate = certify(*solid, Elements(std::vector<Element>{box}));
    EXPECT_NEAR(certificate.growth, 2, 1e-3);
    EXPECT_EQ(certificate.pieces, 2u); // the triangle, and its gap
}

TEST(ElementCertificate, SpheresAloneHaveAProofOfTheirOwn) {
    const auto solid = Solid::make(test::ball({}, 1, 6));
    for (const double radius : {0.5, 2.0}) {
        const std::vector<Sphere> spheres{{{}, radius}, {{0.1, 0, 0}, radius}};
        const Certificate own = certify(*solid, spheres),
                          first = certify_to_first_gap(*solid, Elements(spheres));
        EXPECT_EQ(first.holds, own.holds);
        EXPECT_EQ(first.growth, own.growth);
        EXPECT_EQ(first.pieces, own.pieces);
    }
}

TEST(ElementCertificate, ATriangleInOneElementIsOnePiece) {
    const auto solid = Solid::make(test::ball({}, 1, 6));
    const Element box{.kind = Kind::box, .half = {2, 2, 2}};
    const Certificate certificate = certify(*solid, Elements(std::vector<Element>{box}));
    EXPECT_TRUE(certificate.holds);
    EXPECT_EQ(certificate.pieces, solid->surface().triangles.size());
    EXPECT_EQ(certificate.growth, 0);
}

TEST(ElementCertificate, TheGapIsThatOfThePointThatIsFarthestFromAllElements) {
    Random random(2);
    int open = 0;
    for (int k = 0; k < 25; ++k) {
        const auto solid = Solid::make(test::ball({1, 2, 3}, 1, 4));
        const Mesh& mesh = solid->surface();
        const std::vector<Element> elements = strewn(mesh, 3 + k, 0.3, random);
        double gap = 0;
        std::size_t at = 0;
        constexpr int n = 24;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            for (int i = 0; i <= n; ++i) {
                for (int j = 0; i + j <= n; ++j) {
                    const Vec3 p = (mesh.vertices[a] * i + mesh.vertices[b] * j + mesh.vertices[c] * (n - i - j)) / n;
                    double nearest = inf;
                    for (const Element& e : elements) {
                        nearest = std::min(nearest, distance(e, p));
                    }
                    at = nearest > gap ? t : at;
                    gap = std::max(gap, nearest);
                }
            }
        }
        const Elements view{{}, elements};
        const Certificate certificate = certify(*solid, view), first = certify_to_first_gap(*solid, view);
        ASSERT_FALSE(certificate.holds);
        EXPECT_GE(certificate.growth, gap - 1e-12);
        EXPECT_LE(certificate.growth, (gap + 0.02) * 1.0011); // between the points of the grid
        double witness = inf;
        for (const Element& e : elements) {
            witness = std::min(witness, distance(e, certificate.witness));
        }
        EXPECT_NEAR(witness, certificate.growth, 2e-3 * certificate.growth);
        const auto& [a, b, c] = mesh.triangles[certificate.triangle];
        const Corners corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
        EXPECT_LE(distance(closest_on_triangle(corners, certificate.witness), certificate.witness), 1e-12);
        EXPECT_FALSE(first.holds);
        EXPECT_LE(first.pieces, certificate.pieces);
        EXPECT_GT(first.growth, 0);
        open += at == certificate.triangle;
    }
    EXPECT_GT(open, 5);
}

/// Two flat hulls for each triangle, which contain its halves and reach `depth` behind it.
std::vector<Element> plates_on(const Mesh& mesh, double depth, double wider) {
    std::vector<Element> plates;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 corners[] = {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
        const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (const int end : {0, 1}) {
            const std::array part{corners[end], (corners[0] + corners[1]) / 2, corners[2]};
            const Vec3 middle = (part[0] + part[1] + part[2]) / 3;
            std::vector<Vec3> points;
            for (const Vec3& p : part) {
                const Vec3 out = middle + (p - middle) * wider;
                points.push_back(out + normal * 1e-6);
                points.push_back(out - normal * depth);
            }
            plates.push_back({.kind = Kind::hull, .hull = convex_hull(points)});
        }
    }
    return plates;
}

TEST(ElementCertificate, WhatLiesBeneathTheTrianglesOfARoundSideCounts) {
    const auto round = test::primitive_solid(Element::cylinder(1, 0.1));
    const auto flat = Solid::make(round->surface()); // the same triangles
    const std::vector<Element> thin = plates_on(round->surface(), 1e-6, 1.01), deep = plates_on(round->surface(), 0.01, 1.2);
    EXPECT_TRUE(covers(*flat, Elements(thin)));
    EXPECT_FALSE(covers(*round, Elements(thin)));
    EXPECT_TRUE(covers(*flat, Elements(deep)));
    EXPECT_TRUE(covers(*round, Elements(deep)));
}

TEST(ElementCertificate, TheDepthIsThatOfTheBodiesThatProve) {
    // One triangle is held by one element just where the bodies for that number of halvings hold its corners.
    const auto solid = Solid::make(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const Balls pieces(*solid, {}, 0);
    const auto least = [](const auto& holds) { // the smallest height of the element for which it holds
        double low = 0, high = 1;
        while (std::nextafter(low, high) < high) {
            const double middle = std::max((low + high) / 2, std::nextafter(low, high));
            Element box{.kind = Kind::box, .half = {2, 2, middle}};
            (holds(box) ? high : low) = middle;
        }
        return high;
    };
    std::vector<double> found;
    const auto with = [&](int halvings) {
        return least([&](const Element& e) {
            const Bodies bodies(Elements(std::span(&e, 1)), solid->bounds().center(), pieces.extent(),
                                static_cast<std::uint32_t>(halvings));
            return bodies.holds(0, pieces.piece(0));
        });
    };
    for (const auto& [depth, used] : {std::pair{-5, 0}, {0, 0}, {1, 1}, {20, 20}, {40, 40}, {60, 60}, {99, 60}}) {
        const double height =
            least([&](const Element& e) { return certify(*solid, Elements(std::span(&e, 1)), depth).holds; });
        EXPECT_EQ(height, with(3 * used)) << depth;
        EXPECT_GT(height, 0);
    }
    EXPECT_EQ(least([&](const Element& e) { return covers(*solid, Elements(std::span(&e, 1))); }), with(3 * 40));
}

TEST(ElementCertificate, TheGapAmongThreeIsAccurateToAThousandth) {
    // Three equal balls about the corners of a triangle: the centre of its circle is farthest from them.
    Random random(3);
    for (int k = 0; k < 100; ++k) {
        std::array<Vec3, 3> corners;
        std::vector<Element> balls;
        const double start = random.uniform(0, 6);
        for (std::size_t i = 0; i < 3; ++i) {
            const double angle = start + 2.1 * static_cast<double>(i) + random.uniform(-0.3, 0.3);
            corners[i] = {std::cos(angle), std::sin(angle), 0};
            balls.push_back({.kind = Kind::sphere, .radius = 0.1 + 0.005 * k});
            balls.back().pose.translation = corners[i];
        }
        const auto solid = Solid::make(Mesh{{corners.begin(), corners.end()}, {{0, 1, 2}}});
        const double gap = 1 - balls[0].radius;
        const Certificate certificate = certify(*solid, Elements(balls));
        EXPECT_GE(certificate.growth, gap * (1 - 1e-12));
        EXPECT_LE(certificate.growth, gap * 1.0011);
        EXPECT_NEAR(norm(certificate.witness), 0, 0.1);
    }
}

TEST(ElementCertificate, ScalesWithAll) {
    // Powers of two: numbers differ in their exponents alone, so any step that knows a length would do otherwise.
    Random random(4);
    for (int k = 0; k < 10; ++k) {
        const Mesh mesh = test::ball({1, 2, 3}, 1, 4);
        const std::vector<Element> elements = strewn(mesh, 4 * k, 0.4, random);
        for (const int depth : {3, 8, 40}) {
            const Certificate once = certify(*Solid::make(mesh), Elements(elements), depth);
            for (const double by : {0x1p-12, 0x1p12}) {
                Mesh other = mesh;
                for (Vec3& v : other.vertices) {
                    v = v * by;
                }
                std::vector<Element> others = elements;
                for (Element& e : others) {
                    e.pose.translation = e.pose.translation * by;
                    e.half = e.half * by;
                    e.radius *= by;
                }
                const Certificate scaled = certify(*Solid::make(other), Elements(others), depth);
                EXPECT_EQ(scaled.holds, once.holds);
                EXPECT_EQ(scaled.growth, once.growth * by);
                EXPECT_EQ(scaled.pieces, once.pieces);
                EXPECT_EQ(scaled.witness, once.witness * by);
                EXPECT_EQ(scaled.triangle, once.triangle);
            }
        }
    }
}

TEST(ElementCertificate, TheFirstGapEndsTheSearch) {
    // Of a corner that is outside nothing has to be halved, and no triangle after it is looked at.
    const auto solid = Solid::make(Mesh{{{-2, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, -3, 0}}, {{0, 1, 2}, {1, 0, 3}}});
    for (const Kind kind : {Kind::capsule, Kind::box}) {
        Element left{.kind = kind, .half = {0, 0, 0.1}, .radius = 0.5};
        if (kind == Kind::box) {
            left = {.kind = kind, .half = {0.5, 0.5, 0.5}};
        }
        Element right = left;
        left.pose.translation = {-2, 1.5, 0};
        right.pose.translation = {2, 1.5, 0};
        const std::vector<Element> both{left, right};
        const Certificate first = certify_to_first_gap(*solid, Elements(both));
        EXPECT_FALSE(first.holds);
        EXPECT_LE(first.pieces, 2u);
        EXPECT_GT(certify(*solid, Elements(both)).pieces, 4u);
    }
}

TEST(ElementCertificate, PartsThatCutsLeaveCountAsPieces) {
    const auto solid = Solid::make(Mesh{{{-2, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}});
    Element left{.kind = Kind::box, .half = {1.1, 4, 1}}, right = left;
    left.pose.translation.x = -1;
    right.pose.translation.x = 1;
    const std::vector<Element> both{left, right};
    const Certificate certificate = certify(*solid, Elements(both));
    EXPECT_TRUE(certificate.holds);
    EXPECT_EQ(certificate.pieces, 2u); // the triangle, and what one box leaves of it
}

TEST(ElementCertificate, ATriangleInOneBallIsProvedJustWhereTheBodyHoldsItsCorners) {
    // Corners at the ball to the last bits, where distance and squared distance may disagree.
    Random random(5);
    int held = 0, at = 0;
    Element far{.kind = Kind::box, .half = {0.01, 0.01, 0.01}}; // spheres alone have a proof of their own
    far.pose.translation = {5, 0, 0};
    const Elements ball{{{{}, 1}}, {far}};
    for (int k = 0; k < 3000; ++k) {
        const Vec3 direction = test::random_direction(random);
        const double slack = Bodies(ball, {}, 1, 120).slack(0);
        const Vec3 p = direction * (1 - slack + (k % 9 - 4) * 0x1p-53);
        const auto solid = Solid::make(Mesh{{p, -p, p * 0.5}, {{0, 1, 2}}});
        ASSERT_EQ(solid->bounds().center(), Vec3{});
        const Balls pieces(*solid, {}, 120);
        const Bodies bodies(ball, {}, pieces.extent(), 120);
        const bool holds = bodies.holds(0, p) && bodies.holds(0, -p);
        EXPECT_EQ(covers(*solid, ball), holds) << k;
        EXPECT_EQ(certify(*solid, ball).holds, holds) << k;
        held += holds;
        at += !holds && bodies.growth(0, p) == 0;
    }
    EXPECT_GT(held, 500);
    EXPECT_LT(held, 2500);
    EXPECT_GT(at, 5);
}

} // namespace
