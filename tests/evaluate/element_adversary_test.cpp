// Attempts to make the proof for elements pass where a solid sticks out of them: every kind of element around every
// primitive and a mesh, just large enough, and then one number of either changed by much or little, in both ways.
#include "bisection.hpp"
#include "element_truth.hpp"
#include "geometry/plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

#include <functional>

using namespace foam;
using test::Judge;
using test::Quad;
using Kind = Element::Kind;

namespace {

constexpr std::array kinds{Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull};
enum class Inner { box, sphere, cylinder, capsule, mesh };
constexpr std::array inners{Inner::box, Inner::sphere, Inner::cylinder, Inner::capsule, Inner::mesh};

/// Facets of the polyhedron around a cylinder stick out of it by this share of the radius.
constexpr double facet = 0.0025;

struct Case {
    Solid::Part part;
    Element element;
    double size = 1, extent = 1; ///< of the solid; of that and its place

    std::shared_ptr<const Solid> solid() const { return Solid::make(std::vector{part}); }
    Elements view() const { return Elements(std::span(&element, 1)); }
    Quad outside() const { return Judge(element).outside(part); }
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    const Element& e = c.element;
    out << (c.part.mesh ? "mesh" : to_string(c.part.primitive->kind)) << " in " << to_string(e.kind) << ", radius "
        << e.radius << ", half " << e.half.x << ' ' << e.half.y << ' ' << e.half.z;
    return out << ", size " << c.size << ", extent " << c.extent << ", outside " << static_cast<double>(c.outside());
}

/// The lengths that an element or a primitive of its kind has.
std::vector<double*> lengths(Element& e) {
    std::vector<double*> result;
    for (double* length : {&e.radius, &e.half.x, &e.half.y, &e.half.z}) {
        if (*length > 0) {
            result.push_back(length);
        }
    }
    return result;
}

Element scaled(Element e, double factor) {
    for (double* length : lengths(e)) {
        *length *= factor;
    }
    if (e.hull) {
        std::vector<Vec3> points = e.hull->surface.vertices;
        for (Vec3& p : points) {
            p = p * factor;
        }
        e.hull = convex_hull(points);
    }
    return e;
}

/// An element of about the size, at the origin.
Element element_of(Kind kind, double size, Random& random) {
    const auto length = [&] { return size * random.uniform(0.5, 1.5); };
    Element e{.kind = kind};
    if (kind != Kind::box && kind != Kind::hull) {
        e.radius = length();
    }
    if (kind == Kind::box || kind == Kind::swept_box) {
        e.half = {length(), length(), length()};
    } else if (kind == Kind::capsule || kind == Kind::cylinder) {
        e.half.z = length();
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k) {
            points.push_back(
                {k & 1 ? length() : -length(), k & 2 ? length() : -length(), k & 4 ? length() : -length()});
        }
        e.hull = convex_hull(points);
    }
    return e;
}

Solid::Part part_of(Inner inner, const Pose& pose, double size, Random& random) {
    const auto length = [&] { return size * random.uniform(0.5, 1.5); };
    Solid::Part part{nullptr, std::nullopt, pose};
    switch (inner) {
    case Inner::box:
        part.primitive = Element::box({length(), length(), length()});
        break;
    case Inner::sphere:
        part.primitive = Element::sphere(length());
        break;
    case Inner::cylinder:
        part.primitive = Element::cylinder(length(), length());
        break;
    case Inner::capsule:
        part.primitive = Element::capsule(length(), length());
        break;
    case Inner::mesh: {
        std::vector<Vec3> points;
        for (int k = 0; k < 10; ++k) {
            points.push_back(pose * (test::random_direction(random) * length()));
        }
        part.mesh = std::make_shared<const Mesh>(convex_hull(points)->surface);
        part.pose = {};
    }
    }
    return part;
}

/// Makes the element as small as contains the part to the last bit: first as a whole, then one length after another.
void tighten(Case& c) {
    const test::Extremes solid = test::extremes(c.part);
    const auto inside = [&](const Element& e) { return Judge(e).outside(solid) <= 0; };
    c.element = scaled(c.element, test::smallest(0.05, 50, [&](double f) { return inside(scaled(c.element, f)); }));
    for (double* length : lengths(c.element)) {
        const double whole = *length;
        *length = test::smallest(1e-3 * whole, whole, [&](double less) {
            *length = less;
            return inside(c.element);
        });
    }
}

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

void turn(Element& e, const Vec3& axis, double angle) {
    e.pose.rotation = (Pose::from_axis_angle(axis, angle) * Pose{e.pose.rotation, {}}).rotation;
}

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

TEST(ElementGrowth, OfASmallerCopyEndsAtThePrimitive) {
    Random random(9);
    const std::vector<std::pair<Element, Element>> copies{
        {Element::sphere(0.3), {.kind = Kind::sphere, .radius = 0.3}},
        {Element::capsule(0.3, 1), {.kind = Kind::capsule, .half = {0, 0, 0.5}, .radius = 0.3}},
        {Element::cylinder(0.3, 1), {.kind = Kind::cylinder, .half = {0, 0, 0.5}, .radius = 0.3}},
        {Element::box({1, 2, 3}), {.kind = Kind::box, .half = {0.5, 1, 1.5}}}};
    for (const auto& [primitive, element] : copies) {
        for (const double smaller : {1e-3, 1e-6, 1e-9}) {
            const Pose pose = test::random_pose(random, 1);
            Element start = scaled(element, 1 - smaller);
            start.pose = pose;
            const auto solid = Solid::make({{nullptr, primitive, pose}});
            const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{start}))[0];
            // A cylinder grows to the facets around it, and of a capsule either the radius grows or the length.
            const double most = element.kind == Kind::cylinder  ? 2.5 * facet
                                : element.kind == Kind::capsule ? 4 * smaller + 1e-10
                                                                : 1e-10;
            EXPECT_LE(volume(grown), volume(element) * (1 + most)) << to_string(element.kind) << ' ' << smaller;
            EXPECT_GE(volume(grown), volume(element)) << to_string(element.kind) << ' ' << smaller;
        }
    }
}

TEST(ElementGrowth, OnlyTheElementThatAddsLeastGrows) {
    // A bar that sticks out of one of two boxes by a little.
    Element left{.kind = Kind::box, .half = {0.5, 0.2, 0.2}}, right = left;
    left.pose.translation = {-0.45, 0, 0};
    right.pose.translation = {0.45, 0, 0};
    const Mesh bar = test::box({-0.9, -0.1, -0.1}, {0.96, 0.1, 0.1});
    const Elements grown = grown_to_cover(*Solid::make(bar), Elements(std::vector{left, right}));
    EXPECT_NEAR(volume(grown[0]), volume(left), 1e-10);
    EXPECT_NEAR(volume(grown[1]), volume(right) * 1.01, 1e-10);
    EXPECT_NEAR(grown[1].half.y, 0.2, 1e-10);
}

TEST(ElementGrowth, OneEndGrowsWhereOneEndIsOpen) {
    // A bar along z that sticks out of one end.
    for (const double side : {-1.0, 1.0}) {
        const auto solid = Solid::make(test::box({-0.1, -0.1, side < 0 ? -1 : -0.4}, {0.1, 0.1, side < 0 ? 0.4 : 1}));
        const std::vector<std::pair<Element, double>> cases{
            // the end of the core, or of the element, that the corner at (0.1, 0.1, 1) asks for
            {{.kind = Kind::cylinder, .half = {0, 0, 0.45}, .radius = 0.3}, 1},
            {{.kind = Kind::box, .half = {0.3, 0.3, 0.45}}, 1},
            {{.kind = Kind::capsule, .half = {0, 0, 0.45}, .radius = 0.3}, 1 - std::sqrt(0.09 - 0.02)},
            {{.kind = Kind::swept_box, .half = {0.05, 0.05, 0.45}, .radius = 0.3}, 1 - std::sqrt(0.09 - 0.005)}};
        for (const auto& [element, end] : cases) {
            const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{element}))[0];
            EXPECT_NEAR(grown.half.z, (0.45 + end) / 2, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.pose.translation.z, side * (end - 0.45) / 2, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.radius, element.radius, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.half.x, element.half.x, 1e-9) << to_string(element.kind);
        }
    }
}

TEST(ElementGrowth, TheRadiusGrowsToTheFarthestCorner) {
    const auto solid = Solid::make(test::box({-0.3, -0.1, -0.1}, {0.2, 0.1, 0.1}));
    for (const auto& [element, radius] :
         {std::pair{Element{.kind = Kind::sphere, .radius = 0.2}, std::sqrt(0.09 + 0.02)},
          std::pair{Element{.kind = Kind::capsule, .half = {0, 0, 0.45}, .radius = 0.2}, std::sqrt(0.09 + 0.01)},
          std::pair{Element{.kind = Kind::cylinder, .half = {0, 0, 0.45}, .radius = 0.2}, std::sqrt(0.09 + 0.01)}}) {
        const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{element}))[0];
        EXPECT_NEAR(grown.radius, radius, 1e-9) << to_string(element.kind);
        EXPECT_NEAR(grown.half.z, element.half.z, 1e-9) << to_string(element.kind);
    }
}

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

TEST_P(ElementAdversary, TwoElementsWithASlitBetweenThem) {
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

TEST_P(ElementAdversary, RoundPrimitivesInTwoElements) {
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

/// A thin element upon a facet: it holds the triangle, and reaches beneath it by less than the facet is above the true
/// surface.
Element plate(Kind kind, const Vec3& a, const Vec3& b, const Vec3& c, double thick) {
    const Vec3 x = normalized(b - a), z = normalized(cross(b - a, c - a)), y = cross(z, x);
    const double low = std::min({0.0, dot(c - a, x)}), high = std::max({dot(b - a, x), dot(c - a, x)});
    const double width = dot(c - a, y);
    Element e{.kind = kind};
    e.pose.rotation = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
    e.pose.translation = a + x * ((low + high) / 2) + y * (width / 2);
    e.half = {(high - low) / 2, width / 2, thick};
    if (kind == Kind::swept_box) {
        e.half.z = thick / 2;
        e.radius = thick / 2;
    } else if (kind == Kind::cylinder) {
        e.radius = std::hypot(e.half.x, e.half.y) + thick;
        e.half = {0, 0, thick};
    } else if (kind == Kind::box) {
        e.half += Vec3{thick, thick, 0};
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        const Vec3 middle = (a + b + c) / 3;
        for (const Vec3& corner : {a, b, c}) {
            const Vec3 wider = corner + (corner - middle) * 1e-9;
            points.insert(points.end(), {wider + z * thick, wider - z * thick});
        }
        e.pose = {};
        e.half = {};
        e.hull = convex_hull(points);
    }
    return e;
}

/// The point of the true surface that is deepest beneath the polyhedron around the primitive.
Vec3 beneath_a_corner(const Element& primitive) {
    const bool cylinder = primitive.kind == Element::Kind::cylinder;
    Vec3 result{};
    double deepest = 0;
    for (Vec3 p : enclosing_mesh(primitive).vertices) {
        p.z = cylinder ? 0.3 * p.z : p.z; // between the ends of an edge
        const Vec3 axis{0, 0, cylinder ? p.z : std::clamp(p.z, -primitive.half.z, primitive.half.z)};
        if (const double depth = distance(p, axis) - primitive.radius; depth > deepest) {
            deepest = depth;
            result = axis + normalized(p - axis) * primitive.radius;
        }
    }
    return result;
}

TEST(ElementShells, PlatesUponTheFacetsOfARoundPrimitiveAreNoCover) {
    // The polyhedron around the primitive is covered, and the true surface beneath its corners is not.
    Random random(6);
    for (const Kind kind : {Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull}) {
        for (const auto inner : {Element::Kind::cylinder, Element::Kind::sphere, Element::Kind::capsule}) {
            const Pose pose = test::random_pose(random, 1);
            const Element primitive = test::round_element(inner, 1, 1);
            const Mesh shell = transformed(enclosing_mesh(primitive), pose);
            const auto plates = [&](double thick) {
                std::vector<Element> result;
                for (const auto& [a, b, c] : shell.triangles) {
                    const auto& v = shell.vertices;
                    result.push_back(plate(kind, v[a], v[b], v[c], thick));
                }
                return result;
            };
            const auto solid = Solid::make({{nullptr, primitive, pose}});
            const std::vector<Element> thin = plates(1e-5), thick = plates(0.05);
            EXPECT_TRUE(std::all_of(thin.begin(), thin.end(), [&](const Element& e) {
                return Judge(e).outside(test::quad(pose * beneath_a_corner(primitive))) > 0;
            }));
            EXPECT_TRUE(covers(*Solid::make(shell), Elements(thin))) << to_string(kind);
            EXPECT_FALSE(covers(*solid, Elements(thin))) << to_string(kind) << ' ' << to_string(inner);
            EXPECT_TRUE(covers(*solid, Elements(thick))) << to_string(kind) << ' ' << to_string(inner);
        }
    }
}

} // namespace
