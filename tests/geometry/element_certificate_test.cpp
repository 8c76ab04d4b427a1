// Attempts to make the proof for convex elements pass where a point is uncovered. What is true is computed here in
// extended precision, by other code.
#include "evaluate/element_truth.hpp"
#include "plain_shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

#include <optional>

using namespace foam;
using Kind = Element::Kind;

namespace {

using Long = long double;

struct LongVec {
    Long x, y, z;
};
LongVec operator-(const LongVec& a, const LongVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Long dot(const LongVec& a, const LongVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
LongVec cross(const LongVec& a, const LongVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LongVec long_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// An element in extended precision: the image of its shape by p -> R p + t, whatever R is.
class Judge {
public:
    explicit Judge(const Element& e) : e_(e) {
        // The inverse of R by its cofactors.
        const LongVec a = long_of(e.pose.rotation[0]), b = long_of(e.pose.rotation[1]), c = long_of(e.pose.rotation[2]);
        const LongVec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
        const Long d = dot(a, bc);
        inverse_[0] = {bc.x / d, ca.x / d, ab.x / d};
        inverse_[1] = {bc.y / d, ca.y / d, ab.y / d};
        inverse_[2] = {bc.z / d, ca.z / d, ab.z / d};
        if (e.hull) {
            const Mesh& m = e.hull->surface;
            for (const auto& [i, j, k] : m.triangles) {
                const LongVec at = long_of(m.vertices[i]);
                LongVec n = cross(long_of(m.vertices[j]) - at, long_of(m.vertices[k]) - at);
                const Long length = std::sqrt(dot(n, n));
                n = {n.x / length, n.y / length, n.z / length};
                planes_.push_back({n, dot(n, at)});
            }
        }
    }

    bool holds(const LongVec& p) const {
        const LongVec v = p - long_of(e_.pose.translation);
        const LongVec q{dot(inverse_[0], v), dot(inverse_[1], v), dot(inverse_[2], v)};
        const Long r = e_.radius;
        if (e_.kind == Kind::hull) { // triangles of one face are not quite in one plane, and slender ones are turned
            return std::all_of(planes_.begin(), planes_.end(),
                               [&](const auto& plane) { return dot(plane.first, q) <= plane.second; }) ||
                   holds_exactly(p);
        }
        if (e_.kind == Kind::ellipsoid) {
            const LongVec u{q.x / e_.half.x, q.y / e_.half.y, q.z / e_.half.z};
            return dot(u, u) <= 1;
        }
        if (e_.kind == Kind::cylinder) {
            return q.x * q.x + q.y * q.y <= r * r && std::abs(q.z) <= e_.half.z;
        }
        const auto out = [](Long x, Long half) { return x > half ? x - half : x < -half ? x + half : 0; };
        const LongVec o{out(q.x, e_.half.x), out(q.y, e_.half.y), out(q.z, e_.half.z)};
        return dot(o, o) <= r * r;
    }

private:
    /// Takes the hull of the vertices in quadruple precision.
    bool holds_exactly(const LongVec& p) const {
        if (!exact_) {
            exact_.emplace(e_);
        }
        return exact_->outside(test::QuadPoint{p.x, p.y, p.z}) <= 0;
    }

    Element e_;
    std::array<LongVec, 3> inverse_;
    std::vector<std::pair<LongVec, Long>> planes_;
    mutable std::optional<test::Judge> exact_;
};

class Jury {
public:
    explicit Jury(const Elements& elements) : judges_(elements.begin(), elements.end()) {}
    bool hold(const LongVec& p) const {
        return std::any_of(judges_.begin(), judges_.end(), [&](const Judge& j) { return j.holds(p); });
    }
    bool hold(const Vec3& p) const { return hold(long_of(p)); }

    /// Number of points of the mesh outside all elements: `count` inside the triangles, on their edges and corners.
    std::size_t outside(const Mesh& mesh, std::size_t count, Random& random) const {
        std::size_t found = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
            Long u = random.uniform(), v = random.uniform();
            switch (random.below(8)) { // one of eight is on an edge, one of 64 is a corner
            case 0:
                v = random.below(8) == 0 ? 0 : v;
                u = v == 0 && random.below(2) ? 0 : 1 - v;
                break;
            default:
                if (u + v > 1) {
                    u = 1 - u;
                    v = 1 - v;
                }
            }
            const LongVec a = long_of(mesh.vertices[t[0]]), b = long_of(mesh.vertices[t[1]]) - a,
                          c = long_of(mesh.vertices[t[2]]) - a;
            found += !hold(LongVec{a.x + u * b.x + v * c.x, a.y + u * b.y + v * c.y, a.z + u * b.z + v * c.z});
        }
        return found;
    }

private:
    std::vector<Judge> judges_;
};

Element small_element(Kind kind, const Vec3& at, double size, Random& random) {
    Element e;
    e.kind = kind;
    e.pose = test::random_pose(random, 0);
    e.pose.translation = at;
    const double h = size * random.uniform(0.2, 1);
    switch (kind) {
    case Kind::sphere:
        e.radius = h;
        break;
    case Kind::capsule:
    case Kind::cylinder:
        e.radius = h;
        e.half.z = size * random.uniform(0.2, 1);
        break;
    case Kind::box:
    case Kind::swept_box:
    case Kind::ellipsoid:
        e.half = {h, size * random.uniform(0.2, 1), size * random.uniform(0.2, 1)};
        e.radius = kind == Kind::swept_box ? size * random.uniform(0.1, 0.5) : 0;
        break;
    case Kind::hull: {
        std::vector<Vec3> points;
        for (int i = 0; i < 12; ++i) {
            points.push_back(test::random_direction(random) * h);
        }
        e.hull = convex_hull(points);
        break;
    }
    }
    return e;
}

/// A smaller element of the same kind: by about `share` of its size in every direction.
Element shrunk(Element e, double share) {
    const double size = e.radius + norm(e.half);
    const auto less = [&](double length) { return length > 0 ? length - share * size : 0; };
    e.radius = less(e.radius);
    e.half = {less(e.half.x), less(e.half.y), less(e.half.z)};
    if (e.hull) {
        std::vector<Vec3> points = e.hull->surface.vertices;
        const Vec3 middle = bounds(e.hull->surface).center();
        for (Vec3& p : points) {
            p = middle + (p - middle) * (1 - 2 * share);
        }
        e.hull = convex_hull(points);
    }
    return e;
}

Mesh scaled(Mesh mesh, double size, const Vec3& away) {
    for (Vec3& v : mesh.vertices) {
        v = v * size + away;
    }
    return mesh;
}

Mesh random_mesh(int i, Random& random) {
    switch (i % 5) {
    case 0:
        return test::ball({0.1, 0.2, 0.3}, 0.5, 8);
    case 1:
        return transformed(test::box({-0.5, -0.3, -0.1}, {0.6, 0.2, 0.3}), test::random_pose(random, 0.5));
    case 2: { // an open sheet with a needle
        Mesh mesh{{{0, 0, 0}, {1, 0, 0.1}, {0, 1, -0.1}, {1, 1, 0.2}, {3, 3, 1}, {3, 3.001, 1}},
                  {{0, 1, 2}, {1, 3, 2}, {0, 4, 5}}};
        return mesh;
    }
    case 3: // hollow
        return test::together(test::ball({0, 0, 0}, 0.5, 6), test::flipped(test::ball({0, 0, 0}, 0.3, 6)));
    default: // flat
        return Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
    }
}

class EachKind : public ::testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EachKind,
                         ::testing::Values(Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box,
                                           Kind::hull, Kind::ellipsoid),
                         [](const auto& kind) { return to_string(kind.param); });

#ifdef FOAM_TEST_FEW
constexpr std::size_t samples = 200'000; // a kind
constexpr int planes = 4;
#else
constexpr std::size_t samples = 10'000'000; // a kind
constexpr int planes = 20;
#endif

TEST_P(EachKind, WhatIsProvedHoldsAllPointsAndALittleLessDoesNot) {
    constexpr int runs = 50;
    Random random(derive_seed(1, to_string(GetParam())));
    for (int run = 0; run < runs; ++run) {
        const double size = std::pow(10, random.uniform(-3, 3));
        const double away = run % 3 == 0 ? 0 : run % 3 == 1 ? size : 1e3 * size;
        const Mesh mesh = scaled(random_mesh(run, random), size, Vec3{1, -2, 0.5} * away);
        const auto solid = Solid::make(mesh);
        const Vec3 middle = solid->bounds().center();
        std::vector<Element> start{small_element(GetParam(), middle, 0.1 * size, random)};
        if (run % 2 == 1) {
            start.push_back(small_element(GetParam(), middle + Vec3{0.3, 0, 0} * size, 0.2 * size, random));
        }
        // An ellipsoid grows point by point, to more than the least.
        const bool tight = start.size() == 1 && GetParam() != Kind::ellipsoid &&
                           (GetParam() != Kind::hull || run % 5 < 2 || run % 5 == 3);
        if (tight && GetParam() == Kind::hull) { // hulls grow by faces, not by the least volume
            start[0].hull = convex_hull(mesh.vertices);
            start[0].pose = {};
        }
        const Elements level = grown_to_cover(*solid, Elements(start));
        ASSERT_EQ(level.are_spheres(), GetParam() == Kind::sphere);
        ASSERT_EQ(level.size(), start.size());
        const Certificate certificate = certify(*solid, level);
        ASSERT_TRUE(certificate.holds) << run;
        EXPECT_EQ(Jury(level).outside(solid->surface(), samples / runs, random), 0u) << run;
        std::vector<Element> less;
        for (const Element& e : level) {
            less.push_back(shrunk(e, 1e-9));
        }
        const Certificate refused = certify(*solid, Elements(less));
        if (tight) { // growth was least, so that a corner is outside now
            ASSERT_FALSE(refused.holds) << run;
            EXPECT_FALSE(Jury(less).hold(refused.witness)) << run;
            EXPECT_GT(refused.growth, 0);
            EXPECT_LT(refused.growth, 1e-6 * size * 10);
        } else if (refused.holds) {
            EXPECT_EQ(Jury(less).outside(solid->surface(), samples / runs, random), 0u) << run;
        }
    }
}

TEST_P(EachKind, RefusesANeedleBetweenTwo) {
    // Two elements far apart with a needle from one to the other.
    Random random(derive_seed(2, to_string(GetParam())));
    for (int run = 0; run < 10; ++run) {
        Element a = small_element(GetParam(), {0, 0, 0}, 0.2, random), b = a;
        b.pose.translation = {2, 0, 0};
        const auto solid = Solid::make(Mesh{{{0, 0, 0}, {2, 0, 0}, {0, 1e-6, 0}}, {{0, 1, 2}}});
        const std::vector<Element> two{a, b};
        const Certificate c = certify(*solid, Elements(two));
        ASSERT_FALSE(c.holds);
        EXPECT_FALSE(Jury(two).hold(c.witness));
        const Elements grown = grown_to_cover(*solid, Elements(two));
        EXPECT_TRUE(certify(*solid, grown).holds);
        EXPECT_EQ(Jury(grown).outside(solid->surface(), 10'000, random), 0u);
    }
}

TEST_P(EachKind, RotationsThatAreNotQuiteOrthonormal) {
    Random random(derive_seed(3, to_string(GetParam())));
    for (int run = 0; run < 20; ++run) {
        const auto solid = Solid::make(random_mesh(run, random));
        Element e = small_element(GetParam(), solid->bounds().center(), 0.1, random);
        for (Vec3& row : e.pose.rotation) {
            row += test::random_direction(random) * 2e-7;
        }
        ASSERT_TRUE(is_valid(e));
        const Elements level = grown_to_cover(*solid, Elements(std::vector<Element>{e}));
        ASSERT_TRUE(certify(*solid, level).holds);
        EXPECT_EQ(Jury(level).outside(solid->surface(), 20'000, random), 0u) << run;
    }
}

TEST_P(EachKind, HugeAndTinyNumbers) {
    Random random(derive_seed(4, to_string(GetParam())));
    const Mesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
    for (const double away : {1e6, 1e9}) {
        const auto solid = Solid::make(scaled(mesh, 1, {away, -away, away}));
        Element e = small_element(GetParam(), solid->bounds().center(), 0.5, random);
        const Elements level = grown_to_cover(*solid, Elements(std::vector<Element>{e}));
        ASSERT_TRUE(certify(*solid, level).holds);
        EXPECT_EQ(Jury(level).outside(solid->surface(), 20'000, random), 0u);
    }
    for (const double size : {1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300}) {
        const auto solid = Solid::make(scaled(mesh, size, {}));
        std::vector<Element> e{small_element(GetParam(), {0, 0, 0}, 10 * size, random)};
        const Certificate c = certify(*solid, Elements(e));
        if (c.holds) {
            EXPECT_EQ(Jury(std::vector{e}).outside(solid->surface(), 1'000, random), 0u);
        }
        e = {small_element(GetParam(), {0, 0, 0}, 0.3 * size, random)};
        EXPECT_FALSE(certify(*solid, Elements(e)).holds) << size;
    }
}

TEST_P(EachKind, WhatIsNotValidHoldsNothing) {
    Random random(derive_seed(5, to_string(GetParam())));
    const auto solid = Solid::make(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const Element good = small_element(GetParam(), {}, 1, random);
    ASSERT_TRUE(certify(*solid, Elements(std::vector<Element>{good})).holds);
    for (const double bad : {nan, infinity, -1.0}) {
        Element e = good;
        (GetParam() == Kind::hull || GetParam() == Kind::box || GetParam() == Kind::ellipsoid ? e.half.x : e.radius) = bad;
        EXPECT_FALSE(is_valid(e));
        EXPECT_FALSE(certify(*solid, Elements(std::vector<Element>{e})).holds);
        if (GetParam() == Kind::sphere) { // which has no rotation, and grows from any radius
            continue;
        }
        EXPECT_THROW(grown_to_cover(*solid, Elements(std::vector<Element>{e})), Error);
        e = good;
        e.pose.rotation[1].y = bad;
        EXPECT_FALSE(certify(*solid, Elements(std::vector<Element>{e})).holds);
    }
    // A box with a radius is no swept box: a proof that took it for one would prove points that no box holds.
    const bool box = GetParam() == Kind::box || GetParam() == Kind::swept_box || GetParam() == Kind::ellipsoid;
    const bool along = box || GetParam() == Kind::capsule || GetParam() == Kind::cylinder;
    const auto with_size = [&](auto set) {
        Element e = good;
        set(e);
        return is_valid(e);
    };
    EXPECT_EQ(with_size([](Element& e) { e.half.x = 0.01; }), box);
    EXPECT_EQ(with_size([](Element& e) { e.half.y = 0.01; }), box);
    EXPECT_EQ(with_size([](Element& e) { e.half.z = 0.01; }), along);
    EXPECT_EQ(with_size([](Element& e) { e.radius = 0.01; }),
              GetParam() != Kind::box && GetParam() != Kind::hull && GetParam() != Kind::ellipsoid);
    Element mirrored = good;
    mirrored.pose.rotation[0] = -mirrored.pose.rotation[0];
    EXPECT_FALSE(is_valid(mirrored));
}

TEST(ElementCertificate, WhatIsNotValidBesideOthersHoldsNothing) {
    // Besides others, since spheres alone have a proof of their own.
    const auto solid = Solid::make(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    const auto is_held = [&](const Elements& elements) {
        Elements all(std::vector{test::box_between({90, 0, 0}, {91, 1, 1})});
        all.add(elements);
        return covers(*solid, all);
    };
    Element box{.kind = Kind::box, .half = {1, 1, 1}}, ball{.kind = Kind::sphere, .radius = 1};
    EXPECT_TRUE(is_held(std::vector{box}));
    EXPECT_TRUE(is_held(std::vector{ball}));
    box.radius = 0.1; // of another kind
    ball.radius = -1;
    EXPECT_FALSE(is_held(std::vector{box}));
    EXPECT_FALSE(is_held(std::vector{ball}));
    EXPECT_FALSE(is_held(std::vector{Element{.kind = Kind::hull, .radius = 1}})); // without a hull
    const std::vector<Sphere> none{{{}, std::numeric_limits<double>::infinity()}, {{}, -1}};
    EXPECT_FALSE(is_held(none));
    EXPECT_TRUE(is_held(std::vector{none[0], none[1], Sphere{{}, 1}}));
}

Element box_between(double from, double to, const Pose& pose) {
    Element e;
    e.kind = Kind::box;
    e.half = {(to - from) / 2, 1, 1};
    e.pose.translation = {(from + to) / 2, 0, 0};
    return moved(e, pose);
}

Element hull_between(double from, double to, const Pose& pose) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) {
        points.push_back(pose * Vec3{k & 1 ? from : to, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
    }
    Element e;
    e.kind = Kind::hull;
    e.hull = convex_hull(points);
    return e;
}

TEST(ElementGrowth, NeedlesAcrossTwoElementsNeedNoMoreThanWhatIsOpen) {
    Element left{.kind = Element::Kind::capsule, .radius = 0.31};
    left.pose = Pose::from_axis_angle({1, 0, 0}, std::numbers::pi / 2);
    left.pose.translation = {-0.213, 0.05, 0};
    left.half = {0, 0, 0.42};
    Element right = left;
    right.pose.translation = {0.287, -0.05, 0};
    for (const double thickness : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3}) {
        for (const double open : {1e-9, 1e-7, 1e-5}) {
            SCOPED_TRACE(std::to_string(1e9 * thickness) + " nm thick, " + std::to_string(1e9 * open) + " nm open");
            Mesh needle{{{-0.3, 0.2, 0}, {0.35, 0.2, 0}, {0.1, 0.2, thickness}}, {{0, 1, 2}}};
            // Where the two meet, the needle is open.
            const double meets = 0.037;
            Elements level(std::vector{left, right});
            level.shaped()[0].radius = meets + 0.213 - open;
            level.shaped()[1].radius = 0.287 - meets - open;
            const auto solid = Solid::make(needle);
            const Certificate before = certify(*solid, level);
            ASSERT_FALSE(before.holds);
            const double across = 2 * thickness * thickness; // capsules are round
            EXPECT_LT(before.growth, 2 * open + across + 1e-9);
            const Elements grown = grown_to_cover(*solid, level);
            EXPECT_TRUE(certify(*solid, grown).holds);
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_LT(grown[i].radius - level[i].radius, 3 * open + 2 * across + 1e-7) << i;
            }
        }
    }
}

// Only the faces that a point is above are looked at for its distance from a hull.
TEST(ElementCertificate, TheGapBesideAHullIsTheDistance) {
    Random random(17);
    const auto place = [&](double size) {
        return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    int outside = 0;
    for (int k = 0; k < 300; ++k) {
        std::vector<Vec3> points;
        for (int i = 0; i < 5 + k % 40; ++i) {
            points.push_back(place(1));
        }
        Element hull{.kind = Kind::hull};
        hull.hull = convex_hull(points);
        const Vec3 p = place(k % 2 == 0 ? 1.2 : 5);
        double distance = std::numeric_limits<double>::infinity();
        const Mesh& surface = hull.hull->surface;
        for (const auto& [a, b, c] : surface.triangles) {
            const Corners t{surface.vertices[a], surface.vertices[b], surface.vertices[c]};
            distance = std::min(distance, norm(p - closest_on_triangle(t, p)));
        }
        const double side = 1e-9; // of a triangle that is hardly more than the point
        const auto solid = Solid::make(Mesh{{p, p + Vec3{side, 0, 0}, p + Vec3{0, side, 0}}, {{0, 1, 2}}});
        if (const Certificate certificate = certify(*solid, Elements(std::span(&hull, 1))); !certificate.holds) {
            EXPECT_NEAR(certificate.growth, distance, 4 * side + 1e-3 * distance) << k;
            ++outside;
        }
    }
    EXPECT_GT(outside, 200);
}

/// Expects that elements are proved to cover the solid, cut where they meet instead of halved down to their overlap.
void expect_proved_by_cuts(const Solid& solid, const std::vector<Element>& elements, Random& random) {
    const Certificate certificate = certify(solid, Elements(elements));
    EXPECT_TRUE(certificate.holds);
    EXPECT_LT(certificate.pieces, 100u);
    EXPECT_EQ(Jury(elements).outside(solid.surface(), 10'000, random), 0u);
}

TEST(ElementCertificate, PolytopesThatMeetAtAPlane) {
    Random random(6);
    for (int run = 0; run < planes; ++run) {
        const Pose pose = run == 0 ? Pose{} : test::random_pose(random, 1);
        const auto solid = Solid::make(transformed(test::box({-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}), pose));
        for (const auto& make : {box_between, hull_between}) {
            for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
                SCOPED_TRACE(gap);
                const std::vector<Element> apart{make(-1, -gap / 2, pose), make(gap / 2, 1, pose)};
                const Certificate open = certify(*solid, Elements(apart));
                EXPECT_FALSE(open.holds) << gap;
                EXPECT_LT(open.pieces, 50'000u);
                EXPECT_LT(open.growth, 3 * gap + 1e-9);
                expect_proved_by_cuts(*solid, {make(-1, gap / 2, pose), make(-gap / 2, 1, pose)}, random);
            }
            const Elements level = grown_to_cover(*solid, Elements(std::vector<Element>{make(-1, 0, pose), make(0, 1, pose)}));
            const Certificate touching = certify(*solid, level);
            EXPECT_TRUE(touching.holds);
            EXPECT_LT(touching.pieces, 100u);
            for (const Element& e : level) {
                EXPECT_NEAR(volume(e), 4, 1e-10);
            }
        }
    }
}

Element swept_box_between(double from, double to, const Pose& pose) {
    Element e{.kind = Kind::swept_box, .radius = 0.1};
    e.half = {(to - from) / 2 - e.radius, 1 - e.radius, 1 - e.radius};
    e.pose.translation = {(from + to) / 2, 0, 0};
    return moved(e, pose);
}

Element cylinder_between(double from, double to, const Pose& pose) {
    Element e{.kind = Kind::cylinder, .radius = 2};
    e.half = {0, 0, (to - from) / 2};
    e.pose = Pose::from_axis_angle({0, 1, 0}, std::numbers::pi / 2);
    e.pose.translation = {(from + to) / 2, 0, 0};
    return moved(e, pose);
}

TEST(ElementCertificate, RoundElementsThatHardlyOverlap) {
    Random random(7);
    for (int run = 0; run < 20; ++run) {
        const Pose pose = run == 0 ? Pose{} : test::random_pose(random, 1);
        const auto solid = Solid::make(transformed(test::box({-0.9, -0.8, -0.8}, {0.9, 0.8, 0.8}), pose));
        for (const auto& make : {swept_box_between, cylinder_between}) {
            for (const double gap : {1e-3, 1e-6, 1e-8}) {
                SCOPED_TRACE(gap);
                const std::vector<Element> apart{make(-1, -gap / 2, pose), make(gap / 2, 1, pose)};
                EXPECT_FALSE(certify(*solid, Elements(apart)).holds) << gap;
                expect_proved_by_cuts(*solid, {make(-1, gap / 2, pose), make(-gap / 2, 1, pose)}, random);
            }
        }
    }
}

/// Upright elements in a square grid of pitch 1 over [0, 6]², which cover it with some room.
std::vector<Element> grid_of(Kind kind) {
    std::vector<Element> elements;
    for (int x = 0; x <= 6; ++x) {
        for (int y = 0; y <= 6; ++y) {
            Element e{.kind = kind, .radius = 0.8};
            e.half = kind == Kind::swept_box ? Vec3{0.3, 0.3, 0.1} : kind == Kind::sphere ? Vec3{} : Vec3{0, 0, 0.5};
            e.radius = kind == Kind::swept_box ? 0.4 : 0.8;
            e.pose.translation = {static_cast<double>(x), static_cast<double>(y), 0.01 * x};
            elements.push_back(e);
        }
    }
    return elements;
}

// A triangle across many round elements is cut where they meet, and at half its length where there are more than two.
TEST(ElementCertificate, ATriangleAcrossManyRoundElementsTakesFewPieces) {
    const auto solid = Solid::make(Mesh{{{0, 0, 0}, {6, 0.3, 0}, {0.2, 6, 0.1}, {6, 6, 0}}, {{0, 1, 2}, {1, 3, 2}}});
    for (const auto& [kind, pieces] : {std::pair{Kind::capsule, 400u}, std::pair{Kind::cylinder, 400u},
                                       std::pair{Kind::swept_box, 550u}, std::pair{Kind::sphere, 400u}}) {
        const std::vector<Element> elements = grid_of(kind);
        const Certificate certificate = certify(*solid, Elements(elements));
        EXPECT_TRUE(certificate.holds) << to_string(kind);
        EXPECT_LT(certificate.pieces, pieces) << to_string(kind);
    }
}

TEST(ElementCertificate, AHoleInsideATriangleWhoseEdgesAreCovered) {
    const auto solid = Solid::make(Mesh{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}}, {{0, 1, 2}}});
    const std::vector<Vec3>& c = solid->surface().vertices;
    std::vector<Element> capsules;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = c[k], b = c[(k + 1) % 3], along = normalized(b - a);
        Element e;
        e.kind = Kind::capsule;
        e.pose.rotation = {Vec3{-along.y, 0, along.x}, Vec3{along.x, 0, along.y}, Vec3{0, 1, 0}};
        e.pose.translation = (a + b) * 0.5;
        e.half.z = norm(b - a) / 2;
        e.radius = 0.3;
        ASSERT_TRUE(is_valid(e));
        capsules.push_back(e);
    }
    Certificate open = certify(*solid, Elements(capsules));
    EXPECT_FALSE(open.holds);
    EXPECT_FALSE(Jury(capsules).hold(open.witness));
    // the incircle of the triangle: its radius closes the hole
    const double in =
        norm(cross(c[1] - c[0], c[2] - c[0])) / (norm(c[1] - c[0]) + norm(c[2] - c[1]) + norm(c[0] - c[2]));
    EXPECT_NEAR(open.growth, in - 0.3, 2e-3 * (in - 0.3));
    for (const double radius : {in * (1 - 1e-4), in * (1 + 1e-4)}) {
        for (Element& e : capsules) {
            e.radius = radius;
        }
        EXPECT_EQ(certify(*solid, Elements(capsules)).holds, radius > in);
    }
}

TEST(ElementCertificate, PrimitivesInElementsOfTheirKind) {
    Random random(7);
    for (int run = 0; run < 20; ++run) {
        const Pose pose = test::random_pose(random, run % 2 ? 1 : 0);
        const std::vector<std::pair<Element, Element>> cases{
            {Element::sphere(0.3), {.kind = Kind::sphere, .pose = pose, .radius = 0.3}},
            {Element::capsule(0.3, 1),
             {.kind = Kind::capsule, .pose = pose, .half = {0, 0, 0.5}, .radius = 0.3}},
            {Element::cylinder(0.3, 1),
             {.kind = Kind::cylinder, .pose = pose, .half = {0, 0, 0.5}, .radius = 0.3}},
            {Element::box({1, 2, 3}), {.kind = Kind::box, .pose = pose, .half = {0.5, 1, 1.5}}}};
        for (const auto& [primitive, element] : cases) {
            const auto solid = test::primitive_solid(primitive, pose);
            EXPECT_TRUE(certify(*solid, Elements(std::vector<Element>{element})).holds) << to_string(primitive.kind);
            const Element less = shrunk(element, 1e-9);
            const Certificate refused = certify(*solid, Elements(std::vector<Element>{less}));
            EXPECT_FALSE(refused.holds) << to_string(primitive.kind);
            const Elements level = grown_to_cover(*solid, Elements(std::vector<Element>{less}));
            EXPECT_TRUE(certify(*solid, level).holds) << to_string(primitive.kind);
        }
        // around others, in closed form: no larger than by rounding
        const auto ball = test::primitive_solid(Element::sphere(0.3), pose);
        Element box{.kind = Kind::box, .pose = pose, .half = Vec3{1, 1, 1} * (0.3 * (1 + 1e-12))};
        box.pose.rotation = test::random_pose(random, 0).rotation;
        EXPECT_TRUE(certify(*ball, Elements(std::vector<Element>{box})).holds);
        box.half.x = 0.2999;
        EXPECT_FALSE(certify(*ball, Elements(std::vector<Element>{box})).holds);
    }
}

TEST(ElementCertificate, SpheresAndOthersTogether) {
    Random random(8);
    const auto solid = Solid::make(test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}));
    const Element box = box_between(0, 1.1, {});
    const std::vector<Sphere> ball{{{-0.5, 0, 0}, 0.6}};
    EXPECT_TRUE(certify(*solid, Elements{ball, {box}}).holds);
    EXPECT_FALSE(certify(*solid, Elements(std::vector<Element>{box})).holds);
    const std::vector<Sphere> small{{{-0.5, 0, 0}, 0.5}};
    EXPECT_FALSE(certify(*solid, Elements{small, {box}}).holds);
    const Elements level = grown_to_cover(*solid, Elements{small, {box}});
    EXPECT_TRUE(certify(*solid, level).holds);
    EXPECT_GE(level.spheres()[0].radius, 0.5);
    EXPECT_NEAR(level.spheres()[0].radius, std::sqrt(0.25 + 0.08), 1e-6);
    const Certificate spheres = certify(*solid, Elements(ball));
    EXPECT_EQ(spheres.growth, certify(*solid, ball).growth);
}

} // namespace
