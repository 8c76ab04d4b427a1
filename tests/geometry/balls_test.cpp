// What the proof of cover is made of: slack, halves, prisms beneath curved facets, and the balls that are asked. Each
// against a formula of docs/dev/certificate.md or against looking at everything.
#include "geometry/shapes.hpp"
#include "geometry/src/proof/cover.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;
using geometry::Balls;
using geometry::Piece;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double area_of(const geometry::Corners& t) {
    return 0.5 * norm(cross(t.b - t.a, t.c - t.a));
}

std::vector<double> edges_of(const geometry::Corners& t) {
    return {distance(t.a, t.b), distance(t.b, t.c), distance(t.c, t.a)};
}

Piece flat(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {.corners = {a, b, c}, .beneath = {}};
}

/// The prism from a triangle straight down by `depths`.
Piece prism(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& depths) {
    const Vec3 down = -1.0 * normalized(cross(b - a, c - a));
    return {.corners = {a, b, c},
            .beneath = {a + depths.x * down, b + depths.y * down, c + depths.z * down},
            .curved = true};
}

} // namespace

TEST(Balls, SlackIsWhatTheProofAsksFor) {
    // With a caution of 10^9 the slack's digits can be read off.
    Random random(1);
    for (const double offset : {0.0, 1.0, 1e4}) {
        for (int round = 0; round < 20; ++round) {
            const Vec3 at = random_vector(random, offset);
            const auto solid = Solid::make(triangle(at + random_vector(random, 1), at + random_vector(random, 1), at));
            const Vec3 origin = solid->bounds().center(), center = at + random_vector(random, 2);
            const double radius = random.uniform(0.1, 3), caution = 1e9;
            double extent = 0;
            for (const Vec3& v : solid->surface().vertices) {
                extent = std::max(extent, distance(v, origin));
            }
            for (const std::uint32_t most : {0u, 120u, 180u}) {
                Balls balls(*solid, std::vector<Sphere>{{center, radius}}, most, caution);
                const auto slack = [&](double r) { // twice 2u is an epsilon
                    return caution * epsilon *
                           ((most + 8) * (extent + distance(center, origin) + r) + 8 * norm(origin));
                };
                EXPECT_NEAR(balls.extent(), extent, 1e-12 * (1 + offset));
                EXPECT_NEAR((radius - balls.radius(0)) / slack(radius), 1, 1e-5);
                EXPECT_NEAR((balls.full_radius(0, radius) - radius) / (2 * slack(2 * radius)), 1, 1e-5);
                balls.set_radius(0, 2 * radius);
                EXPECT_NEAR((2 * radius - balls.radius(0)) / slack(2 * radius), 1, 1e-5);
                balls.set_radius(0, balls.full_radius(0, radius));
                EXPECT_GE(balls.radius(0), radius) << "what is asked for is held";
                balls.set_radius(0, -radius);
                EXPECT_NEAR((-radius - balls.radius(0)) / slack(radius), 1, 1e-5) << "never larger by its sign";
            }
            const Balls usual(*solid, std::vector<Sphere>{{center, radius}}, 120);
            EXPECT_NEAR((radius - usual.radius(0)) /
                            (epsilon * (128 * (extent + distance(center, origin) + radius) + 8 * norm(origin))),
                        1, 0.02)
                << "once, if nothing is said";
        }
    }
}

TEST(Balls, OfNoUsableSizeHoldNothing) { // certificate_test has more
    const auto point = Solid::make(triangle({}, {}, {}));
    Balls balls(*point, std::vector<Sphere>{{{}, 1}, {{std::nan(""), 0, 0}, 1}, {{}, std::nan("")}}, 120);
    EXPECT_LE(balls.full_radius(0, 0), 2.001e-140);
    balls.set_radius(0, balls.full_radius(0, 0));
    EXPECT_TRUE(balls.holds(0, Vec3{})) << "what just holds a point";
    for (const std::uint32_t none : {1u, 2u}) {
        EXPECT_FALSE(balls.holds(none, Vec3{}));
        EXPECT_EQ(balls.radius(none), -std::numeric_limits<double>::infinity());
    }
}

TEST(Balls, HoldAPieceOnlyWithAllItsCorners) {
    // One corner at a time is moved out of the ball.
    const auto solid = Solid::make(triangle({-1, -1, -1}, {1, 1, 1}, {0, 0, 0}));
    const Balls balls(*solid, std::vector<Sphere>{{{}, 1}}, 120);
    const Piece inside = prism({0.5, 0, 0.1}, {0, 0.5, 0.1}, {-0.5, 0, 0.1}, {0.1, 0.2, 0.3});
    ASSERT_TRUE(balls.holds(0, inside));
    for (const bool beneath : {false, true}) {
        for (Vec3 geometry::Corners::*corner : {&geometry::Corners::a, &geometry::Corners::b, &geometry::Corners::c}) {
            Piece piece = inside;
            geometry::Corners& moved = beneath ? piece.beneath : piece.corners;
            moved.*corner = {0, 0, 1 + 1e-9};
            EXPECT_FALSE(balls.holds(0, piece));
            EXPECT_NEAR(reach({}, piece), 1 + 1e-9, 1e-15);
            const geometry::PiecePoints points(piece);
            EXPECT_EQ(points.count, 6u);
            EXPECT_TRUE(std::any_of(points.begin(), points.end(), [](const Vec3& p) { return p.z > 1; }));
            piece.curved = false;
            EXPECT_EQ(balls.holds(0, piece), beneath) << "beneath a flat facet lies nothing that is asked for";
            EXPECT_EQ(reach({}, piece) < 1, beneath);
            EXPECT_EQ(geometry::PiecePoints(piece).count, 3u);
        }
    }
}

TEST(Balls, AreClosed) {
    // A radius that is 0.5 without slack, and corners at that distance.
    const auto solid = Solid::make(triangle({0.5, 0, 0}, {-0.5, 0, 0}, {0, 0, 0}));
    Balls balls(*solid, std::vector<Sphere>{{{}, 1}}, 120);
    double full = balls.full_radius(0, 0.5);
    while (balls.radius(0) != 0.5 && full > 0.5) {
        full = std::nextafter(full, 0);
        balls.set_radius(0, full);
    }
    ASSERT_EQ(balls.radius(0), 0.5);
    for (const Vec3& far : {Vec3{0.5, 0, 0}, Vec3{0, -0.5, 0}}) {
        EXPECT_TRUE(balls.holds(0, far));
        EXPECT_TRUE(balls.holds(0, flat(far, {}, {})));
        EXPECT_TRUE(balls.holds(0, flat({}, far, {})));
        EXPECT_TRUE(balls.holds(0, flat({}, {}, far)));
        EXPECT_EQ(balls.gap(0, far), 0);
        EXPECT_EQ(balls.power(0, far), 0);
    }
    EXPECT_FALSE(balls.holds(0, Vec3{std::nextafter(0.5, 1), 0, 0}));
    EXPECT_EQ(balls.gap(0, {2, 0, 0}), 1.5);
    EXPECT_EQ(balls.power(0, {2, 0, 0}), 3.75);
}

TEST(Pieces, SizeAndDiameter) {
    const Piece piece = flat({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
    EXPECT_DOUBLE_EQ(size_of(piece), 5);
    EXPECT_DOUBLE_EQ(diameter_of(piece), 5);
    for (const Vec3& depths : {Vec3{7, 1, 2}, Vec3{1, 7, 2}, Vec3{1, 2, 7}}) {
        const Piece high = prism({0, 0, 0}, {3, 0, 0}, {0, 4, 0}, depths);
        EXPECT_DOUBLE_EQ(size_of(high), 7);
        EXPECT_DOUBLE_EQ(diameter_of(high), 12);
    }
    EXPECT_DOUBLE_EQ(size_of(prism({0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1, 1, 2})), 5);
    for (const auto& [a, b, c] : {std::tuple(Vec3{9, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 0}),
                                  std::tuple(Vec3{0, 1, 0}, Vec3{0, 0, 0}, Vec3{9, 0, 0})}) {
        EXPECT_DOUBLE_EQ(size_of(flat(a, b, c)), std::hypot(9, 1));
    }
}

TEST(Pieces, HalvesTileThePiece) {
    Random random(2);
    for (int round = 0; round < 200; ++round) {
        const Piece piece = flat(random_vector(random, 1), random_vector(random, 1), random_vector(random, 1));
        const auto [first, second] = halves(piece);
        const std::vector<double> edges = edges_of(piece.corners);
        const auto longest = static_cast<std::size_t>(std::max_element(edges.begin(), edges.end()) - edges.begin());
        const geometry::Corners& t = piece.corners;
        const std::array<Vec3, 3> corner{t.a, t.b, t.c};
        const Vec3 middle = (corner[longest] + corner[(longest + 1) % 3]) * 0.5;
        EXPECT_EQ(first.level, 1u);
        EXPECT_EQ(second.level, 1u);
        EXPECT_NEAR(area_of(first.corners), area_of(t) / 2, 1e-14);
        EXPECT_NEAR(area_of(second.corners), area_of(t) / 2, 1e-14);
        EXPECT_NEAR(norm((cross(first.corners.b - first.corners.a, first.corners.c - first.corners.a) +
                          cross(second.corners.b - second.corners.a, second.corners.c - second.corners.a)) -
                         cross(t.b - t.a, t.c - t.a)),
                    0, 1e-14)
            << "both turn as the whole does";
        for (const Piece& half : {first, second}) {
            const geometry::PiecePoints points(half);
            int known = 0;
            for (const Vec3& p : points) {
                known += p == t.a || p == t.b || p == t.c || p == middle;
            }
            EXPECT_EQ(known, 3);
        }
    }
    // Of equal edges the first is cut.
    const auto [first, second] = halves(flat({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}));
    EXPECT_EQ(first.corners.b, (Vec3{1, 0, 0}));
    EXPECT_EQ(second.corners.a, (Vec3{1, 0, 0}));
    EXPECT_EQ(halves(flat({0, 0, 0}, {1, 2, 0}, {0, 4, 0})).first.corners.c, (Vec3{0, 2, 0}))
        << "the last, the longest";
    EXPECT_EQ(halves(flat({0, 0, 0}, {1, 0, 0}, {0.5, 3, 0})).first.corners.c, (Vec3{0.75, 1.5, 0})) << "of the others";
    EXPECT_EQ(halves(flat({0.5, 3, 0}, {0, 0, 0}, {1, 0, 0})).first.corners.b, (Vec3{0.25, 1.5, 0}))
        << "first and last";
}

TEST(Pieces, HalvesOfAPrismTileIt) {
    const Piece wide = prism({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {1, 2, 3});
    const auto [left, right] = halves(wide); // between b and c
    EXPECT_TRUE(left.curved && right.curved);
    EXPECT_EQ(left.corners.c, (Vec3{2, 1.5, 0}));
    EXPECT_EQ(left.beneath.c, (Vec3{2, 1.5, -2.5}));
    EXPECT_EQ(left.beneath.a, wide.beneath.a);
    EXPECT_EQ(left.beneath.b, wide.beneath.b);
    EXPECT_EQ(right.beneath.b, left.beneath.c);
    EXPECT_EQ(right.beneath.c, wide.beneath.c);
    const Piece high = prism({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {10, 12, 14});
    const auto [upper, lower] = halves(high);
    EXPECT_EQ(upper.corners.a, high.corners.a);
    EXPECT_EQ(upper.corners.c, high.corners.c);
    EXPECT_EQ(upper.beneath.a, (Vec3{0, 0, -5}));
    EXPECT_EQ(upper.beneath.b, (Vec3{4, 0, -6}));
    EXPECT_EQ(upper.beneath.c, (Vec3{0, 3, -7}));
    EXPECT_EQ(lower.corners.a, upper.beneath.a);
    EXPECT_EQ(lower.corners.b, upper.beneath.b);
    EXPECT_EQ(lower.corners.c, upper.beneath.c);
    EXPECT_EQ(lower.beneath.a, high.beneath.a);
    EXPECT_EQ(lower.beneath.c, high.beneath.c);
    EXPECT_EQ(upper.level, 1u);
    EXPECT_EQ(lower.level, 1u);
    // As high as its longest edge is long: across.
    EXPECT_EQ(halves(prism({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {5, 5, 5})).first.corners.c, (Vec3{2, 1.5, 0}));
}

TEST(Balls, CandidatesAreAllThatMayBeNearest) {
    Random random(3);
    for (int round = 0; round < 300; ++round) {
        const double size = round % 2 == 0 ? 1 : 0.03;
        const auto solid = Solid::make(
            triangle(random_vector(random, size), random_vector(random, size), random_vector(random, size)));
        std::vector<Sphere> spheres;
        for (int i = round; i >= 0; --i) {
            spheres.push_back({random_vector(random, 2), random.uniform(-0.1, round % 3 == 0 ? 0.2 : 0.9)});
        }
        Balls balls(*solid, spheres, 120);
        balls.set_radius(0, 1.5); // what was known of the largest is known anew
        balls.set_radius(static_cast<std::uint32_t>(round), 0.1);
        const Piece piece = balls.piece(0);
        const Vec3 middle = (piece.corners.a + piece.corners.b + piece.corners.c) / 3;
        std::vector<std::pair<double, std::uint32_t>> gaps;
        for (std::uint32_t i = 0; i < balls.size(); ++i) {
            gaps.push_back({balls.gap(i, middle), i});
        }
        std::sort(gaps.begin(), gaps.end());
        std::vector<std::uint32_t> expected, found, all(balls.size()), chosen;
        for (const auto& [gap, i] : gaps) {
            if (gap <= gaps[0].first + 2.001 * reach(middle, piece) &&
                (expected.empty() || !balls.holds(gaps[0].second, piece))) {
                expected.push_back(i);
            }
        }
        balls.candidates(piece, found);
        ASSERT_FALSE(found.empty());
        EXPECT_EQ(found[0], gaps[0].second) << "the nearest to the middle is the first";
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(found, expected);
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            all[i] = i;
        }
        chosen = all;
        balls.candidates(piece, 0, all.size(), chosen);
        EXPECT_EQ(chosen[all.size()], gaps[0].second);
        chosen.erase(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(all.size()));
        std::sort(chosen.begin(), chosen.end());
        if (!balls.holds(gaps[0].second, piece)) {
            EXPECT_EQ(chosen, expected);
        }
        const std::size_t half = all.size() / 2; // no more than the range that is given, and none of it twice
        chosen = all;
        if (half > 0) {
            balls.candidates(piece, half, all.size(), chosen);
            EXPECT_TRUE(std::all_of(chosen.begin() + static_cast<std::ptrdiff_t>(all.size()), chosen.end(),
                                    [&](std::uint32_t i) { return i >= half; }));
        }
    }
}

TEST(Balls, OfEqualOnesTheFirstIsAsked) {
    const auto solid = Solid::make(triangle({1, 0, 0}, {-1, 1, 0}, {0, -1, 0}));
    const Balls balls(*solid, std::vector<Sphere>(20, {{0, 0, 1}, 1.1}), 120);
    std::vector<std::uint32_t> found;
    balls.candidates(balls.piece(0), found);
    EXPECT_EQ(found[0], 0u);
    EXPECT_EQ(found.size(), 20u);
    std::vector<std::uint32_t> chosen{3, 2, 5};
    balls.candidates(balls.piece(0), 0, 3, chosen);
    EXPECT_EQ(chosen, (std::vector<std::uint32_t>{3, 2, 5, 3, 2, 5}));
    const Balls none(*solid, {}, 120);
    found.clear();
    none.candidates(none.piece(0), found);
    EXPECT_TRUE(found.empty());
    const Balls no_radius(*solid, std::vector<Sphere>{{{}, std::nan("")}}, 120);
    no_radius.candidates(no_radius.piece(0), found);
    EXPECT_TRUE(found.empty());
}

namespace {

using Long = long double;

/// How far straight below a facet's corner the primitive's surface lies, along the facet's normal.
double depth_below(const Element& primitive, const Pose& pose, const Vec3& corner, const Vec3& normal) {
    const Vec3 along = pose.rotate({0, 0, 1}), v = corner - pose.translation;
    const double half = primitive.half.z;
    const Vec3 p = v - std::clamp(dot(v, along), -half, half) * along; // from the nearest point of the axis
    const Long b = Long(p.x) * normal.x + Long(p.y) * normal.y + Long(p.z) * normal.z;
    const Long c = Long(p.x) * p.x + Long(p.y) * p.y + Long(p.z) * p.z - Long(primitive.radius) * primitive.radius;
    return static_cast<double>(b * b > c ? b - std::sqrt(b * b - c) : b);
}

} // namespace

TEST(Balls, ThePrismBeneathAFacetReachesTheTrueSurface) {
    const Pose pose = Pose::from_xyz_rpy({0.3, -0.2, 0.1}, {0.4, 0.5, 0.6});
    for (const Element& primitive :
         {Element::cylinder(0.1, 0.3), Element::capsule(0.1, 0.3),
          Element::sphere(0.1)}) {
        const auto solid = Solid::make({{std::make_shared<const Mesh>(box({1, 1, 1}, {2, 2, 2})), {}, {}},
                                        {nullptr, primitive, pose},
                                        {nullptr, Element::box({1, 1, 1}), Pose{}}});
        const Balls balls(*solid, std::vector<Sphere>{{{}, 1}}, 120);
        const auto offsets = solid->part_offsets();
        std::size_t flat_ones = 0, deep = 0;
        for (std::uint32_t i = 0; i < balls.piece_count(); ++i) {
            const Piece piece = balls.piece(i);
            if (i < offsets[1] || i >= offsets[2]) {
                EXPECT_FALSE(piece.curved) << "meshes and boxes have no prisms";
                continue;
            }
            const geometry::Corners& t = piece.corners;
            const Vec3 normal = normalized(cross(t.b - t.a, t.c - t.a));
            const bool end =
                primitive.kind == Element::Kind::cylinder && std::abs(dot(normal, pose.rotate({0, 0, 1}))) > 0.9;
            EXPECT_EQ(piece.curved, !end);
            flat_ones += end;
            for (Vec3 geometry::Corners::*corner :
                 {&geometry::Corners::a, &geometry::Corners::b, &geometry::Corners::c}) {
                const Vec3 top = piece.corners.*corner, down = top - piece.beneath.*corner;
                if (piece.curved) {
                    const double depth = depth_below(primitive, pose, balls.to_solid(top), normal);
                    EXPECT_NEAR(norm(down), std::max(depth, 0.0), 1e-12);
                    EXPECT_NEAR(dot(down, normal), norm(down), 1e-15);
                    deep += depth > 1e-5;
                }
            }
        }
        EXPECT_EQ(flat_ones > 0, primitive.kind == Element::Kind::cylinder);
        EXPECT_GT(deep, 30u);
    }
}
