// Proofs that elements leave no cavity in a solid, against solids that are full by construction and cavities that are put into
// them, and against dense samples of random covers.
#include "geometry/plain_shapes.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace foam {
namespace {

using Kind = Element::Kind;

std::shared_ptr<const Solid> solid_box(const Vec3& size, const Pose& pose = {}) {
    return Solid::make(std::vector{Solid::Part{nullptr, Element::box(size), pose}});
}

/// An element of the kind about a cube of this edge, with a hair of overlap.
Element around_cube(Kind kind, double edge, double hair) {
    const double half = edge / 2, diagonal = std::sqrt(3.0) * half;
    switch (kind) {
    case Kind::sphere:
        return Element::sphere(diagonal + hair);
    case Kind::capsule:
        return Element::capsule(std::sqrt(2.0) * half + hair, edge);
    case Kind::cylinder:
        return Element::cylinder(std::sqrt(2.0) * half + hair, edge + 2 * hair);
    case Kind::box:
        return Element::box(Vec3{1, 1, 1} * (edge + 2 * hair));
    case Kind::swept_box:
        return {.kind = kind, .half = Vec3{1, 1, 1} * half, .radius = hair};
    case Kind::ellipsoid:
        return Element::ellipsoid(Vec3{1, 1.2, 1.1} * (diagonal + hair));
    case Kind::hull: {
        const double h = half + hair;
        std::vector<Vec3> corners;
        for (int k = 0; k < 8; ++k) {
            corners.push_back({k & 1 ? h : -h, k & 2 ? h : -h, k & 4 ? h : -h});
        }
        return {.kind = kind, .hull = convex_hull(corners)};
    }
    }
    return {};
}

/// Elements around the cubes of edge 1 of a block of n³, those left out that `skip` says.
template <class Skip> Elements block(Kind kind, int n, double hair, const Pose& pose, Skip skip) {
    Elements elements;
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            for (int z = 0; z < n; ++z) {
                if (!skip(x, y, z)) {
                    Element e = around_cube(kind, 1, hair);
                    e.pose.translation = Vec3{x + 0.5, y + 0.5, z + 0.5} - Vec3{1, 1, 1} * (0.5 * n);
                    elements.add(moved(e, pose));
                }
            }
        }
    }
    return elements;
}

class EachKindFills : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, EachKindFills, ::testing::ValuesIn(every_kind()),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(EachKindFills, AFullBlockHasNoCavity) {
    Random random(1);
    const bool flat = GetParam() == Kind::box || GetParam() == Kind::hull; // cut along their faces, however little they overlap
    for (const double hair : {flat ? 1e-9 : 1e-4, 1e-3}) {
        for (const bool turned : {false, true}) {
            const Pose pose = turned ? test::random_pose(random, 3) : Pose{};
            const Elements elements = block(GetParam(), 3, hair, pose, [](int, int, int) { return false; });
            const auto solid = solid_box({3, 3, 3}, pose);
            ASSERT_TRUE(certify_surface(*solid, elements).holds);
            const SolidProof proof = prove_solid(*solid, elements);
            EXPECT_TRUE(proof.holds) << hair << ' ' << turned << ", " << proof.pieces << " pieces, "
                                     << proof.witness.x << ' ' << proof.witness.y << ' ' << proof.witness.z;
        }
    }
}

TEST_P(EachKindFills, AMissingCubeInsideIsFound) {
    Random random(2);
    for (int round = 0; round < 4; ++round) {
        const Pose pose = round > 0 ? test::random_pose(random, 3) : Pose{};
        const auto is_middle = [](int x, int y, int z) { return x == 2 && y == 2 && z == 2; };
        const bool round_kind = GetParam() == Kind::sphere || GetParam() == Kind::ellipsoid;
        const auto skip = [&](int x, int y, int z) { // round ones reach far into their neighbours
            return round_kind ? std::abs(x - 2) + std::abs(y - 2) + std::abs(z - 2) <= 1 : is_middle(x, y, z);
        };
        const Elements elements = block(GetParam(), 5, 1e-6, pose, skip);
        const auto solid = solid_box({5, 5, 5}, pose);
        ASSERT_TRUE(certify_surface(*solid, elements).holds);
        const SolidProof proof = prove_solid(*solid, elements, true);
        ASSERT_FALSE(proof.holds);
        ASSERT_TRUE(proof.found);
        EXPECT_TRUE(solid->contains(proof.witness));
        for (const Element& e : elements) {
            EXPECT_GE(signed_distance(e, proof.witness), proof.depth * (1 - 1e-9));
        }
        EXPECT_GT(proof.depth, 0);
        for (const SolidProof::Open& open : proof.open) {
            ASSERT_LT(open.element, elements.size());
            ASSERT_FALSE(open.points.empty());
        }
    }
}

TEST_P(EachKindFills, OneElementAroundASolidIsFull) {
    const auto solid = Solid::make(test::ball({0.1, 0.2, 0.3}, 0.5, 12));
    Element e = around_cube(GetParam(), 1, 0.5);
    e.pose.translation = {0.1, 0.2, 0.3};
    ASSERT_TRUE(certify_surface(*solid, Elements(std::vector{e})).holds);
    EXPECT_TRUE(prove_solid(*solid, Elements(std::vector{e})).holds);
    const std::vector<Element> twice{e, e};
    EXPECT_TRUE(prove_solid(*solid, Elements(twice)).holds) << "the same element twice";
}

TEST(SolidProof, ANarrowSlitBetweenBoxesIsNoProof) {
    for (const double slit : {1e-12, 1e-9, 1e-6, 1e-3}) {
        std::vector<Element> boxes;
        for (const double side : {-1.0, 1.0}) {
            Element e = Element::box({1, 1, 1});
            e.pose.translation = {side * (0.5 + slit / 2), 0, 0};
            boxes.push_back(e);
        }
        // Six thin boxes around hold the surface of a block without the middle.
        const double w = 1 + slit / 2;
        for (int axis = 1; axis < 3; ++axis) {
            for (const double side : {-1.0, 1.0}) {
                Vec3 size{2.2, 1.2, 1.2};
                size[axis] = 0.1;
                Element e = Element::box(size);
                e.pose.translation[axis] = side * 0.5;
                boxes.push_back(e);
            }
        }
        const auto solid = solid_box({2 * w - 1e-9 * w, 1, 1});
        ASSERT_TRUE(certify_surface(*solid, Elements(boxes)).holds);
        const SolidProof proof = prove_solid(*solid, Elements(boxes));
        EXPECT_FALSE(proof.holds) << slit;
        EXPECT_TRUE(!proof.found || std::abs(proof.witness.x) <= slit) << slit;
    }
}

TEST(SolidProof, AnOpenSurfaceHasNoInside) {
    Mesh open = test::box({-1, -1, -1}, {1, 1, 1});
    open.triangles.pop_back();
    const auto solid = Solid::make(open);
    std::vector<Element> walls;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 size{2.2, 2.2, 2.2};
            size[axis] = 0.1;
            Element e = Element::box(size);
            e.pose.translation[axis] = side;
            walls.push_back(e);
        }
    }
    ASSERT_TRUE(certify_surface(*solid, Elements(walls)).holds);
    EXPECT_TRUE(prove_solid(*solid, Elements(walls)).holds);
    const auto closed = Solid::make(test::box({-1, -1, -1}, {1, 1, 1}));
    EXPECT_TRUE(prove_solid(*closed, Elements(walls)).found);
    // A cavity of the solid is no cavity of the elements.
    const auto hollow = Solid::make(
        test::together(test::box({-1, -1, -1}, {1, 1, 1}), test::flipped(test::box({-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}))));
    std::vector<Element> thick = walls;
    for (Element& e : thick) {
        for (int axis = 0; axis < 3; ++axis) {
            e.half[axis] = e.half[axis] < 0.1 ? 0.11 : e.half[axis];
        }
    }
    ASSERT_TRUE(certify_surface(*hollow, Elements(thick)).holds);
    EXPECT_TRUE(prove_solid(*hollow, Elements(thick)).holds);
}

/// Elements so far away that the others are thinner than the rounding there are no reason to look through these.
TEST(SolidProof, ThinPlatesBesideAFarElementAreNoProof) {
    for (const auto& [thin, far] : {std::pair{1e-9, 1e5}, std::pair{1e-11, 1e3}, std::pair{4e-13, 10.0}}) {
        std::vector<Element> elements{Element::box({1, 1, 1})};
        elements[0].pose.translation.x = far;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-1.0, 1.0}) {
                Vec3 size{2.2, 2.2, 2.2};
                size[axis] = thin;
                Element plate = Element::box(size);
                plate.pose.translation[axis] = side;
                elements.push_back(plate);
            }
        }
        EXPECT_FALSE(certify(*solid_box({2, 2, 2}), Elements(elements)).holds) << thin;
    }
}

TEST(SolidProof, AnEllipsoidAboutTheMiddleOfAPieceHoldsIt) {
    Element lower = Element::box({2.2, 2.2, 0.3});
    lower.pose.translation.z = -0.15;
    const std::vector<Element> two{lower, Element::ellipsoid({1.5, 1.5, 0.9})};
    const SolidProof proof = prove_solid(*solid_box({2, 2, 0.4}), Elements(two));
    EXPECT_FALSE(proof.found);
}

/// Elements at random places in the box of edges 1, 1.3 and 0.7.
std::vector<Element> strewn(Kind kind, Random& random) {
    std::vector<Element> elements;
    const int count = 8 + static_cast<int>(random.below(30));
    for (int k = 0; k < count; ++k) {
        Element e = around_cube(kind, random.uniform(0.15, 0.6), 1e-3);
        e.pose = test::random_pose(random, 0);
        e.pose.translation = {random.uniform(-0.5, 0.5), random.uniform(-0.65, 0.65), random.uniform(-0.35, 0.35)};
        elements.push_back(e);
    }
    return elements;
}

/// Random elements in a box, grown until its surface lies in them: whether they fill it is told by a dense sample.
TEST_P(EachKindFills, RandomCoversAreFullWhereProvedAndHollowWhereFound) {
    Random random(derive_seed(3, to_string(GetParam())));
#ifdef FOAM_TEST_FEW
    constexpr int rounds = 20, samples = 20'000;
#else
    constexpr int rounds = 60, samples = 100'000;
#endif
    int full = 0, hollow = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto solid = solid_box({1, 1.3, 0.7});
        const std::vector<Element> elements = strewn(GetParam(), random);
        const Elements grown = grown_to_cover(*as_surface(*solid), Elements(elements));
        const SolidProof proof = prove_solid(*solid, grown);
        full += proof.holds;
        hollow += proof.found;
        const auto held = [&](const Vec3& p) {
            for (const Element& e : grown) {
                if (signed_distance(e, p) <= 0) {
                    return true;
                }
            }
            return false;
        };
        if (proof.found) {
            EXPECT_TRUE(solid->contains(proof.witness) && !held(proof.witness)) << round;
        }
        for (int k = 0; proof.holds && k < samples; ++k) {
            const Vec3 p{random.uniform(-0.5, 0.5), random.uniform(-0.65, 0.65), random.uniform(-0.35, 0.35)};
            ASSERT_TRUE(held(p)) << round << ": " << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
    EXPECT_GT(full, 0);
    // What is round in all directions and grows to the surface leaves hardly a cavity.
    const bool round = GetParam() == Kind::sphere || GetParam() == Kind::capsule || GetParam() == Kind::ellipsoid;
    EXPECT_TRUE(hollow > 0 || round);
}

TEST_P(EachKindFills, GrowthClosesCavities) {
    Random random(derive_seed(4, to_string(GetParam())));
    for (int round = 0; round < 8; ++round) {
        const auto solid = solid_box({1, 1.3, 0.7});
        const std::vector<Element> elements = strewn(GetParam(), random);
        const Elements shell = grown_to_cover(*as_surface(*solid), Elements(elements));
        const Elements grown = grown_to_cover(*solid, shell);
        EXPECT_TRUE(certify(*solid, grown).holds) << round;
        for (std::size_t i = 0; i < shell.size(); ++i) {
            EXPECT_GE(volume(grown[i]), volume(shell[i]) * (1 - 1e-12)) << "none becomes smaller";
        }
        EXPECT_TRUE(certify(*solid, shell).holds == (grown == shell)) << "what covers stays as it is";
    }
}

} // namespace
} // namespace foam
