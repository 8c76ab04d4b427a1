// Proofs by elements: where the gap is, how large, and how many pieces are looked at.
#include "geometry/strewn_elements.hpp"

#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using test::strewn;
using Kind = Element::Kind;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

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

TEST(ElementCertificate, TheDepthIsThatOfTheSlackThatElementsLose) {
    // One triangle is held by one element just where the element is higher than the slack for that number of halvings.
    const auto solid = Solid::make(test::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const auto least = [](const auto& holds) { // the smallest height of the element for which it holds
        double low = 0, high = 1;
        while (std::nextafter(low, high) < high) {
            const double middle = std::max((low + high) / 2, std::nextafter(low, high));
            const Element box{.kind = Kind::box, .half = {2, 2, middle}};
            (holds(Elements(std::span(&box, 1))) ? high : low) = middle;
        }
        return high;
    };
    const auto slack = [&](int halvings) { // docs/dev/certificate.md
        const double unit = 0x1p-53, away = norm(solid->bounds().center()), extent = std::sqrt(0.5),
                     reach = std::sqrt(8);
        return 2 * unit * (halvings + 24) * (extent + away + reach) + 16 * unit * away;
    };
    for (const auto& [depth, used] : {std::pair{-5, 0}, {0, 0}, {1, 1}, {20, 20}, {40, 40}, {60, 60}, {99, 60}}) {
        const double height = least([&](const Elements& e) { return certify(*solid, e, depth).holds; });
        EXPECT_NEAR(height, slack(3 * used), 1e-12 * height) << depth;
    }
    const double height = least([&](const Elements& e) { return covers(*solid, e); });
    EXPECT_NEAR(height, slack(3 * 40), 1e-12 * height);
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
    const auto round = as_surface(*test::primitive_solid(Element::cylinder(1, 0.1)));
    const auto flat = as_surface(*Solid::make(round->surface())); // the same triangles
    const std::vector<Element> thin = plates_on(round->surface(), 1e-6, 1.01), deep = plates_on(round->surface(), 0.01, 1.2);
    EXPECT_TRUE(covers(*flat, Elements(thin)));
    EXPECT_FALSE(covers(*round, Elements(thin)));
    EXPECT_TRUE(covers(*flat, Elements(deep)));
    EXPECT_TRUE(covers(*round, Elements(deep)));
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

} // namespace
