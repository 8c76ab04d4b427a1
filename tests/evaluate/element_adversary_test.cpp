// Attempts to make the proof for elements pass where a solid sticks out of them: every kind of element around every
// primitive and a mesh, just large enough, and then one number of either changed by much or little, in both ways.
#include "tight_elements.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace foam;
using namespace foam::test;

namespace {

enum class Place { same, turned, quarter, elsewhere };
constexpr std::array places{Place::same, Place::turned, Place::quarter, Place::elsewhere};

Element placed(Element e, Place place, const Pose& pose, double size, Random& random) {
    e.pose = pose;
    switch (place) {
    case Place::same:
        break;
    case Place::turned:
        e.pose.rotation = test::random_pose(random, 0).rotation;
        break;
    case Place::quarter: // exactly
        for (Vec3& row : e.pose.rotation) {
            row = {row.z, row.y, -row.x};
        }
        break;
    case Place::elsewhere:
        e.pose = pose * test::random_pose(random, 0.3 * size);
        break;
    }
    return e;
}

Case tight_case(Kind kind, Inner inner, Place place, double size, double away, Random& random) {
    const Pose pose = test::random_pose(random, away);
    Case c;
    c.part = part_of(inner, pose, size, random);
    c.element = placed(element_of(kind, size, random), place, pose, size, random);
    c.size = size;
    c.extent = 3 * size + 2 * away;
    tighten(c);
    return c;
}

using Change = std::function<void(Case&, double)>;

/// Changes of one number by a share: each length, a vertex, the element's turn and place, the solid's place.
std::vector<Change> changes(Case& c, Random& random) {
    std::vector<Change> result{[](Case& x, double share) { x.element = scaled(x.element, 1 + share); }};
    for (std::size_t k = 0; k < lengths(c.element).size(); ++k) {
        result.push_back([k](Case& x, double share) { *lengths(x.element)[k] *= 1 + share; });
    }
    if (c.element.hull) {
        result.push_back([k = random.below(8)](Case& x, double share) {
            std::vector<Vec3> points = x.element.hull->surface.vertices;
            points[k % points.size()] = points[k % points.size()] * (1 + share);
            x.element.hull = convex_hull(points);
        });
    }
    const Vec3 axis = test::random_direction(random), way = test::random_direction(random);
    result.push_back([axis](Case& x, double share) { turn(x.element, axis, share); });
    result.push_back([way](Case& x, double share) { x.element.pose.translation += way * (share * x.size); });
    if (c.part.primitive) {
        for (std::size_t k = 0; k < lengths(*c.part.primitive).size(); ++k) {
            result.push_back([k](Case& x, double share) { *lengths(*x.part.primitive)[k] *= 1 + share; });
        }
        result.push_back([way](Case& x, double share) { x.part.pose.translation += way * (share * x.size); });
    }
    return result;
}

/// How far inside a part has to be for a proof that is due: the polyhedron around a cylinder has to be inside, unless
/// the element is one that contains the cylinder by its lengths.
double margin(const Case& c) {
    const double slack = 1e-12 * c.extent;
    if (c.part.mesh || c.part.primitive->kind != Element::Kind::cylinder) {
        return slack;
    }
    const bool by_lengths =
        c.element.pose == c.part.pose && (c.element.kind == Kind::cylinder || c.element.kind == Kind::capsule) &&
        c.element.radius >= c.part.primitive->radius && c.element.half.z >= c.part.primitive->half.z;
    return by_lengths ? 0 : slack + facet * c.part.primitive->radius;
}

struct Count {
    int outside = 0, inside = 0, undecided = 0;
};

/// Expects that the proof says what is true; between, where the margin is not there, it may say no.
void judge(const Case& c, Count& count) {
    const Judge truth(c.element);
    const Quad outside = truth.outside(c.part);
    const auto solid = c.solid();
    const Certificate certificate = certify(*solid, c.view());
    const bool out = outside > Quad(1e-30) * c.extent, in = outside <= -Quad(margin(c)) + Quad(1e-30) * c.extent;
    (out ? count.outside : in ? count.inside : count.undecided) += 1;
    EXPECT_FALSE(out && certificate.holds) << c;
    EXPECT_TRUE(!in || certificate.holds) << c;
    EXPECT_EQ(covers(*solid, c.view()), certificate.holds) << c;
    if (!certificate.holds) {
        EXPECT_GT(truth.outside(test::quad(certificate.witness)), -1e-12 * c.extent) << c;
        EXPECT_GE(certificate.growth, static_cast<double>(outside) - 1e-12 * c.extent) << c;
    }
}

#ifdef FOAM_TEST_FEW
constexpr std::array shares{0.9, 0.5, 1e-1, 1e-6, 1e-13};
constexpr std::array offsets{1e6};
#else
constexpr std::array shares{0.9, 0.5, 1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14};
constexpr std::array offsets{0.0, 1e6};
#endif

void judge_changes(const Case& tight, Random& random, Count& count) {
    judge(tight, count);
    Case copy = tight;
    for (const Change& change : changes(copy, random)) {
        for (const double share : shares) {
            for (const double sign : {-1.0, 1.0}) {
                Case changed = tight;
                change(changed, sign * share);
                judge(changed, count);
            }
        }
    }
}

class ElementAdversary : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ElementAdversary, ::testing::ValuesIn(kinds),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(ElementAdversary, OneNumberChanged) {
    Random random(derive_seed(1, to_string(GetParam())));
    for (const Inner inner : inners) {
        Count count;
        for (const Place place : places) {
            judge_changes(tight_case(GetParam(), inner, place, 1, 1, random), random, count);
        }
        EXPECT_GT(count.outside, 50) << static_cast<int>(inner);
        EXPECT_GT(count.inside, 10) << static_cast<int>(inner);
    }
}

TEST_P(ElementAdversary, OneNumberChangedAtOtherSizesAndPlaces) {
    Random random(derive_seed(2, to_string(GetParam())));
    const bool hull = GetParam() == Kind::hull; // its planes take fourth powers of lengths
    for (const double size : {hull ? 1e-40 : 1e-100, 1e-6, 1e6, hull ? 1e40 : 1e100}) {
        for (const double away : offsets) {
            Count count;
            judge_changes(
                tight_case(GetParam(), inners[random.below(5)], places[random.below(4)], size, away * size, random),
                random, count);
            EXPECT_GT(count.outside, 5) << size << ' ' << away;
            EXPECT_GT(count.inside, 0) << size << ' ' << away;
        }
    }
}

TEST_P(ElementAdversary, ElementsWithAnInexactRotation) {
    if (GetParam() == Kind::sphere) {
        return; // it has no rotation
    }
    // The image of the shape by the numbers as they are. Of corners it is known exactly what it holds.
    Random random(derive_seed(3, to_string(GetParam())));
    for (int round = 0; round < 10; ++round) {
        Case c = tight_case(GetParam(), round % 2 ? Inner::box : Inner::mesh, Place::elsewhere, 1, 1, random);
        for (Vec3& row : c.element.pose.rotation) {
            row += test::random_direction(random) * (round < 5 ? 1e-7 : 1e-9);
        }
        ASSERT_TRUE(is_valid(c.element));
        for (const double larger : {-1e-6, -1e-7, -1e-8, -1e-10, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5}) {
            Case changed = c;
            changed.element = scaled(c.element, 1 + larger);
            const bool holds = certify(*changed.solid(), changed.view()).holds;
            EXPECT_FALSE(holds && changed.outside() > 0) << changed;
            EXPECT_TRUE(holds || changed.outside() > -3e-6) << changed;
        }
    }
}

TEST_P(ElementAdversary, OneNumberOfTheRotationIsInexact) {
    if (GetParam() == Kind::sphere) {
        return; // it has no rotation
    }
    // Each of the nine alone: none of them may be forgotten.
    Random random(derive_seed(8, to_string(GetParam())));
    for (std::size_t entry = 0; entry < 9; ++entry) {
        for (const double change : {-3e-7, 3e-7}) {
            Case c;
            c.part = part_of(Inner::box, {}, 1, random);
            c.element = element_of(GetParam(), 1, random);
            Vec3& row = c.element.pose.rotation[entry / 3];
            row[static_cast<int>(entry % 3)] += change;
            ASSERT_TRUE(is_valid(c.element));
            tighten(c);
            for (const double larger : {-1e-7, -1e-8, -1e-9, -1e-10, 1e-4}) {
                Case changed = c;
                changed.element = scaled(c.element, 1 + larger);
                const bool holds = certify(*changed.solid(), changed.view()).holds;
                EXPECT_FALSE(holds && changed.outside() > 0) << changed << ", entry " << entry;
                EXPECT_TRUE(holds || larger < 0) << changed << ", entry " << entry;
            }
        }
    }
}

TEST_P(ElementAdversary, WhatHasGrownHoldsTheSolid) {
    Random random(derive_seed(4, to_string(GetParam())));
    for (const Inner inner : inners) {
        for (const Place place : places) {
            for (const double smaller : {0.1, 1e-3, 1e-9, 1e-13}) {
                Case c = tight_case(GetParam(), inner, place, 1, 1, random);
                c.element = scaled(c.element, 1 - smaller);
                c.element.pose.translation += test::random_direction(random) * smaller;
                const Elements grown = grown_to_cover(*c.solid(), Elements(std::vector{c.element}));
                const double before = volume(c.element);
                c.element = grown[0];
                EXPECT_LE(static_cast<double>(c.outside()), 0) << c;
                EXPECT_TRUE(certify(*c.solid(), c.view()).holds) << c;
                EXPECT_GE(volume(c.element), before) << c;
            }
        }
    }
}

} // namespace
