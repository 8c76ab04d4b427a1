// Two elements that share a solid between them, and a slit.
#include "tight_elements.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// Two elements that are mirror images by the plane x = 0 of the frame `pose`, each just around a half of a box.
struct Halves {
    Pose pose;
    Vec3 half; ///< of the box
    Element left, right;

    Solid::Part part() const { return {nullptr, Element::box(half * 2), pose}; }
};

Element moved_along(Element e, const Pose& pose, double x) {
    e.pose.translation += pose.rotate({x, 0, 0});
    return e;
}

/// The half of the box at `side` of the plane: -1 or 1.
Solid::Part half_of(const Halves& h, double side) {
    Pose place = h.pose;
    place.translation = h.pose * Vec3{side * h.half.x / 2, 0, 0};
    return {nullptr, Element::box({h.half.x, 2 * h.half.y, 2 * h.half.z}), place};
}

Halves halves_around(Kind kind, const Pose& pose, const Vec3& half, Random& random) {
    Halves h{pose, half, {}, {}};
    Case c;
    c.part = half_of(h, -1);
    c.element = element_of(kind, 1, random);
    c.element.pose = c.part.pose;
    if (kind == Kind::capsule || kind == Kind::cylinder) { // lies along y, or stands on the plane
        c.element.pose.rotation =
            (c.part.pose *
             Pose::from_axis_angle(kind == Kind::capsule ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, std::numbers::pi / 2))
                .rotation;
    }
    if (kind == Kind::hull) {
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k) {
            points.push_back(
                {(k & 1 ? 0.5 : -0.5) * h.half.x, (k & 2 ? 1 : -1) * h.half.y, (k & 4 ? 1 : -1) * h.half.z});
        }
        c.element.hull = convex_hull(points);
    }
    tighten(c);
    h.left = h.right = c.element;
    h.right.pose = pose * Pose::from_axis_angle({0, 1, 0}, std::numbers::pi) * pose.inverse() * c.element.pose;
    return h;
}

Halves halves(Kind kind, const Pose& pose, Random& random) {
    const auto length = [&] { return random.uniform(0.5, 1.5); };
    const double x = length(), y = length(), z = length();
    return halves_around(kind, pose, {x, y, z}, random);
}

/// Whether a point of the box's outline at x = 0 is in neither element.
bool is_open(const Halves& h) {
    const Judge left(h.left), right(h.right);
    bool open = false;
    for (const Vec3& way :
         {Vec3{0, 1, 1}, Vec3{0, 1, -1}, Vec3{0, -1, 1}, Vec3{0, -1, -1}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const test::QuadPoint p =
            test::quad(h.pose.translation) + test::turned(h.pose, {0, Quad(h.half.y) * way.y, Quad(h.half.z) * way.z});
        open = open || std::min(left.outside(p), right.outside(p)) > 0;
    }
    return open;
}

/// How far the halves of the box stick out of their elements: at most 0 means that the box is covered.
Quad halves_outside(const Halves& h) {
    return std::max(Judge(h.left).outside(half_of(h, -1)), Judge(h.right).outside(half_of(h, 1)));
}
class TwoElements : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, TwoElements, ::testing::ValuesIn(kinds),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(TwoElements, TwoElementsWithASlitBetweenThem) {
    Random random(derive_seed(5, to_string(GetParam())));
    int open = 0, closed = 0;
    for (int round = 0; round < 4; ++round) {
        Halves touching = halves(GetParam(), test::random_pose(random, 1), random);
        if (GetParam() == Kind::box && round % 2) { // half a turn: the opposite faces meet
            for (Element* e : {&touching.left, &touching.right}) {
                turn(*e, touching.pose.rotate({0, 0, 1}), std::numbers::pi);
            }
        }
        for (const double share : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14}) {
            for (const double way : {-1.0, 1.0}) {
                Halves h = touching; // a little larger, so that nothing else is open
                const auto change = [&](const Element& e, double side) {
                    return moved_along(scaled(e, 1 + share), h.pose, side * (way > 0 ? 5 : -0.1) * share);
                };
                h.left = change(touching.left, -1);
                h.right = change(touching.right, 1);
                const std::array both{h.left, h.right};
                const auto solid = Solid::make(std::vector{h.part()});
                const Certificate certificate = certify(*solid, Elements(both));
                EXPECT_EQ(covers(*solid, Elements(both)), certificate.holds);
                if (is_open(h)) {
                    ++open;
                    EXPECT_FALSE(certificate.holds) << share * way;
                    EXPECT_GT(std::min(Judge(h.left).outside(test::quad(certificate.witness)),
                                       Judge(h.right).outside(test::quad(certificate.witness))),
                              -1e-12)
                        << share * way;
                    EXPECT_GT(certificate.growth, 0);
                    const Elements grown = grown_to_cover(*solid, Elements(std::vector<Element>{h.left, h.right}));
                    EXPECT_FALSE(is_open({h.pose, h.half, grown[0], grown[1]})) << share * way;
                }
                if (halves_outside(h) < -1e-11) {
                    ++closed;
                    EXPECT_TRUE(certificate.holds) << share * way << ' ' << round;
                }
            }
        }
    }
    EXPECT_GT(open, 20);
    EXPECT_GT(closed, 20);
}

/// A round primitive that fills the box of the halves but for a hundredth.
Solid::Part inscribed(const Halves& h, Element::Kind kind) {
    const double radius = 0.99 * std::min(h.half.x, h.half.y);
    const double length = std::max(0.1, 2 * (0.99 * h.half.z - (kind == Element::Kind::capsule ? radius : 0)));
    const Pose turned = h.pose * Pose::from_axis_angle({0, 0, 1}, std::numbers::pi / 96); // facets across the plane
    return {nullptr, test::round_element(kind, radius, length), turned};
}

TEST_P(TwoElements, RoundPrimitivesInTwoElements) {
    Random random(derive_seed(7, to_string(GetParam())));
    int open = 0;
    for (int round = 0; round < 9; ++round) {
        const auto kind = std::array{Element::Kind::cylinder, Element::Kind::capsule,
                                     Element::Kind::sphere}[static_cast<std::size_t>(round) % 3];
        const double x = random.uniform(0.5, 1.5), y = random.uniform(0.5, 1.5);
        const double z = std::max(x, y) + (kind == Element::Kind::capsule ? 0.5 : 0);
        const Halves h = halves_around(GetParam(), test::random_pose(random, 1), {x, y, z}, random);
        const auto solid = Solid::make(std::vector{inscribed(h, kind)});
        const double radius = solid->parts()[0].primitive->radius;
        // Pieces of a round surface are halved down to the overlap, which therefore is not small here.
        const std::array wide{scaled(h.left, 1.05), scaled(h.right, 1.05)};
        EXPECT_TRUE(covers(*solid, Elements(wide))) << round;
        for (const double slit : {1e-2, 1e-3}) {
            const std::array apart{moved_along(h.left, h.pose, -slit), moved_along(h.right, h.pose, slit)};
            const test::QuadPoint p = test::quad(h.pose.translation) + test::turned(h.pose, {0, radius, 0});
            if (std::min(Judge(apart[0]).outside(p), Judge(apart[1]).outside(p)) > 0) {
                ++open;
                EXPECT_FALSE(covers(*solid, Elements(apart))) << slit;
            }
        }
    }
    const bool flat = GetParam() == Kind::box || GetParam() == Kind::cylinder || GetParam() == Kind::hull;
    EXPECT_GE(open, flat ? 18 : 0);
}

} // namespace
