// Parts of the proof for elements: what is contained by its lengths, which triangles are open, and where the gap is.
#include "geometry/src/element_proof.hpp"
#include "plain_shapes.hpp"

#include <foam/geometry/element_measure.hpp>
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

bool contains(const Element& e, const Primitive& p) {
    Pose pose;
    pose.translation = {1, 2, 3};
    return contains_by_lengths(e, {nullptr, p, pose});
}

/// Expects that the element contains the primitive, and not if any of these lengths is a last bit smaller.
void expect_just(Element e, const Primitive& p, const std::vector<double Element::*>& radii,
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
    const Primitive ball{Primitive::Kind::sphere, {}, 0.3, 0}, capsule{Primitive::Kind::capsule, {}, 0.3, 1},
        cylinder{Primitive::Kind::cylinder, {}, 0.3, 1}, box{Primitive::Kind::box, {1, 2, 3}, 0, 0};
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
    const Primitive ball{Primitive::Kind::sphere, {}, 0.3, 0}, capsule{Primitive::Kind::capsule, {}, 0.3, 1},
        cylinder{Primitive::Kind::cylinder, {}, 0.3, 1}, box{Primitive::Kind::box, {1, 1, 1}, 0, 0};
    Element hull = element_with(Kind::hull, {}, 0);
    hull.hull = convex_hull(test::box({-9, -9, -9}, {9, 9, 9}).vertices);
    for (const Primitive& p : {ball, capsule, cylinder, box}) {
        EXPECT_FALSE(contains(hull, p));
        EXPECT_FALSE(contains(element_with(Kind::box, {-9, 9, 9}, 0), p));
    }
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
        const Certificate certificate = certify(*solid, ElementsView{{}, elements});
        EXPECT_GE(certificate.pieces, solid->surface().triangles.size());
    }
}

TEST(ElementCertificate, APartThatIsContainedProvesNothingOfOthers) {
    const Primitive ball{Primitive::Kind::sphere, {}, 0.3, 0}, cylinder{Primitive::Kind::cylinder, {}, 0.3, 1};
    Pose right;
    right.translation = {2, 0, 0};
    for (const Primitive& p : {ball, cylinder}) {
        Element left{.kind = Kind::cylinder, .half = {0, 0, 0.5}, .radius = 0.3}, both = left;
        both.pose = right;
        const std::vector<Element> one{left}, two{left, both};
        const auto solid = Solid::make({{nullptr, p, {}}, {nullptr, p, right}});
        EXPECT_FALSE(covers(*solid, ElementsView{{}, one})) << to_string(p.kind);
        EXPECT_TRUE(covers(*solid, ElementsView{{}, two})) << to_string(p.kind);
        const auto reversed = Solid::make({{nullptr, p, right}, {nullptr, p, {}}});
        EXPECT_FALSE(covers(*reversed, ElementsView{{}, one})) << to_string(p.kind);
        EXPECT_TRUE(covers(*reversed, ElementsView{{}, two})) << to_string(p.kind);
    }
}

TEST(ElementCertificate, ASmallTriangleFarAwayIsLookedAtOnce) {
    const auto solid = Solid::make(Mesh{{{3, 0, 0}, {3, 1e-4, 0}, {3, 0, 1e-4}}, {{0, 1, 2}}});
    const Element box{.kind = Kind::box, .half = {1, 1, 1}};
    const Certificate certificate = certify(*solid, ElementsView{{}, std::span(&box, 1)});
    EXPECT_NEAR(certificate.growth, 2, 1e-3);
    EXPECT_EQ(certificate.pieces, 2u); // the triangle, and its gap
}

TEST(ElementCertificate, SpheresAloneHaveAProofOfTheirOwn) {
    const auto solid = Solid::make(test::ball({}, 1, 6));
    for (const double radius : {0.5, 2.0}) {
        const std::vector<Sphere> spheres{{{}, radius}, {{0.1, 0, 0}, radius}};
        const Certificate own = certify(*solid, spheres),
                          first = certify_to_first_gap(*solid, ElementsView{spheres, {}});
        EXPECT_EQ(first.holds, own.holds);
        EXPECT_EQ(first.growth, own.growth);
        EXPECT_EQ(first.pieces, own.pieces);
    }
}

TEST(ElementCertificate, ATriangleInOneElementIsOnePiece) {
    const auto solid = Solid::make(test::ball({}, 1, 6));
    const Element box{.kind = Kind::box, .half = {2, 2, 2}};
    const Certificate certificate = certify(*solid, ElementsView{{}, std::span(&box, 1)});
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
        const ElementsView view{{}, elements};
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

} // namespace
