// Attempts to make the proof of cover pass where a point is uncovered: what is true is computed here in exact or
// quadruple arithmetic, and by other code.
#include "bisection.hpp"
#include "geometry/plain_shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/measure.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

using namespace foam;
using test::random_vector, test::triangle;
using ::testing::HasSubstr;

namespace {

__extension__ typedef __float128 Quad; // 113 bits: the square of a double's difference is exact enough by 1e-33

struct QuadVec {
    Quad x, y, z;
};

QuadVec quad(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// R v + t in quadruple arithmetic.
QuadVec placed(const Pose& pose, const Vec3& v) {
    const auto row = [&](int i, double t) {
        const Vec3& r = pose.rotation[static_cast<std::size_t>(i)];
        return Quad(r.x) * v.x + Quad(r.y) * v.y + Quad(r.z) * v.z + t;
    };
    return {row(0, pose.translation.x), row(1, pose.translation.y), row(2, pose.translation.z)};
}

/// Whether the ball holds the point.
bool inside(const QuadVec& p, const Sphere& ball) {
    const Quad x = p.x - ball.center.x, y = p.y - ball.center.y, z = p.z - ball.center.z;
    return x * x + y * y + z * z <= Quad(ball.radius) * ball.radius;
}

QuadVec operator+(const QuadVec& a, const QuadVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
QuadVec operator-(const QuadVec& a, const QuadVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
QuadVec operator*(const QuadVec& a, Quad factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
}

/// |p - c|² - r².
Quad power(const QuadVec& p, const Sphere& ball) {
    const QuadVec v = p - quad(ball.center);
    return v.x * v.x + v.y * v.y + v.z * v.z - Quad(ball.radius) * ball.radius;
}

/// The most that a triangle's points lie outside balls: the largest of the least powers. Where one ball's power is
/// least, it is convex, so the largest is at a corner of the triangle, where an edge crosses a plane of equal powers,
/// or where two such planes cross in the triangle. All of these are looked at. More than 0: a point is open.
Quad farthest_out(const std::array<Vec3, 3>& corners, const std::vector<Sphere>& balls) {
    const QuadVec a = quad(corners[0]);
    const std::array<QuadVec, 2> axis{quad(corners[1]) - a, quad(corners[2]) - a};
    Quad most = -1e300;
    const auto look = [&](Quad s, Quad t) {
        if (s < 0 || t < 0 || s + t > 1) {
            return;
        }
        Quad least = 1e300;
        for (const Sphere& ball : balls) {
            least = std::min(least, power(a + axis[0] * s + axis[1] * t, ball));
        }
        most = std::max(most, least);
    };
    // Lines in the triangle's plane: u s + v t = w. First the edges, then where two balls' powers are equal.
    std::vector<std::array<Quad, 3>> lines{{1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const auto difference = [&](const QuadVec& p) { return power(p, balls[i]) - power(p, balls[j]); };
            const Quad w = difference(a);
            lines.push_back({difference(a + axis[0]) - w, difference(a + axis[1]) - w, -w});
        }
    }
    look(0, 0);
    look(1, 0);
    look(0, 1);
    for (const auto& one : lines) {
        for (const auto& other : lines) {
            const Quad determinant = one[0] * other[1] - one[1] * other[0];
            if (determinant != 0) {
                // A crossing on an edge is not to be missed by a rounding.
                const Quad hair = 1e-30, s = (one[2] * other[1] - one[1] * other[2]) / determinant,
                           t = (one[0] * other[2] - one[2] * other[0]) / determinant;
                look(s < 0 && s > -hair ? Quad(0) : s, t < 0 && t > -hair ? Quad(0) : t);
            }
        }
    }
    return most;
}

} // namespace

TEST(CertificateAdversary, NoPointBetweenBallsIsOpenAtTheSmallestRadiiThatPass) {
    // What halvings and cuts along lines make of a triangle under some balls, against the exact worst point. In every
    // other case all balls pass through one point of the triangle, in the worst of them along a line.
    Random random(5);
    for (const double offset : {0.0, 1e4}) {
        for (int round = 0; round < 60; ++round) {
            const Vec3 at = random_vector(random, offset);
            const std::array<Vec3, 3> corners{at + random_vector(random, 1), at + random_vector(random, 1),
                                              at + random_vector(random, 1)};
            const Vec3 inner = corners[0] * 0.3 + corners[1] * 0.3 + corners[2] * 0.4;
            const std::size_t count = 2 + random.below(6);
            std::vector<Sphere> balls;
            std::vector<double> sizes;
            for (std::size_t k = 0; k < count; ++k) {
                const double s = random.uniform(), t = random.uniform() * (1 - s);
                const Vec3 center = corners[0] * (1 - s - t) + corners[1] * s + corners[2] * t;
                balls.push_back({round % 4 == 3 ? center : center + random_vector(random, 0.3), 0});
                sizes.push_back(round % 2 ? distance(balls.back().center, inner) : random.uniform(0.5, 1));
            }
            const auto solid = Solid::make(triangle(corners[0], corners[1], corners[2]));
            const auto scaled = [&](double factor) {
                for (std::size_t k = 0; k < count; ++k) {
                    balls[k].radius = sizes[k] * factor;
                }
                return balls;
            };
            const double factor = test::smallest(0.1, 1e4, [&](double f) { return certify(*solid, scaled(f)).holds; });
            EXPECT_LE(double(farthest_out(corners, scaled(factor))), 0) << "offset " << offset << ", " << round;
            EXPECT_GT(double(farthest_out(corners, scaled(factor * (1 - 1e-8)))), 0)
                << "what is covered with room to spare is proved; offset " << offset << ", " << round;
        }
    }
}

TEST(CertificateAdversary, TheSmallestRadiusThatPassesHoldsTheExactCorners) {
    Random random(1);
    for (const double offset : {0.0, 1.0, 1e3, 1e6}) {
        for (const double size : {1e-6, 1.0, 1e6}) {
            for (int round = 0; round < 20; ++round) {
                const Vec3 at = random_vector(random, offset);
                const std::array<Vec3, 3> corners{at + random_vector(random, size), at + random_vector(random, size),
                                                  at + random_vector(random, size)};
                const auto solid = Solid::make(triangle(corners[0], corners[1], corners[2]));
                const Vec3 center = at + random_vector(random, size);
                const double radius = test::smallest(size * 1e-3, size * 1e3 + 1, [&](double r) {
                    return certify(*solid, std::vector<Sphere>{{center, r}}).holds;
                });
                for (const Vec3& corner : corners) {
                    EXPECT_TRUE(inside(quad(corner), {center, radius})) << "offset " << offset << ", size " << size;
                }
                const double needed = std::max(
                    {distance(center, corners[0]), distance(center, corners[1]), distance(center, corners[2])});
                EXPECT_LT(radius, needed + 1e-12 * (needed + offset)) << "caution costs no more than rounding does";
            }
        }
    }
}

TEST(CertificateAdversary, AnUlpLessThanTheSmallestRadiusFails) {
    // Corners exactly on a sphere of radius 3 · 2^k; all balls smaller by a last bit, and all that pass, are told.
    for (const double unit : {0x1p-40, 1.0, 0x1p40}) {
        const auto solid = Solid::make(triangle(Vec3{1, 2, 2} * unit, Vec3{-2, 1, 2} * unit, Vec3{2, -2, 1} * unit));
        const auto passes = [&](double r) { return certify(*solid, std::vector<Sphere>{{{}, r}}).holds; };
        const double radius = test::smallest(2.5 * unit, 3.5 * unit, passes);
        EXPECT_GE(radius, 3 * unit);
        EXPECT_LT(radius, 3 * unit * (1 + 1e-12));
        EXPECT_TRUE(passes(radius));
        EXPECT_FALSE(passes(std::nextafter(radius, 0.0)));
        EXPECT_FALSE(passes(std::nextafter(3 * unit, 0.0)));
    }
}

TEST(CertificateAdversary, AHoleWhereBallsMeetInOnePoint) {
    // Balls around the origin whose surfaces meet there. If all are smaller than the distances of their centres, the
    // origin is open, by however little.
    Random random(2);
    for (const double offset : {0.0, 1e6}) {
        for (int round = 0; round < 10; ++round) {
            const Vec3 at = random_vector(random, offset);
            const double turn = random.uniform(0, 6);
            std::vector<Sphere> balls;
            for (int k = 0; k < 4; ++k) {
                const double angle = turn + std::numbers::pi * k / 2;
                balls.push_back({at + 2 * Vec3{std::cos(angle), std::sin(angle), 0.1}, 0});
            }
            const auto solid = Solid::make(triangle(at + Vec3{-1, -1, 0}, at + Vec3{1, -1, 0}, at + Vec3{0, 1, 0}));
            const double radius = test::smallest(1.9, 2.2, [&](double r) {
                for (Sphere& ball : balls) {
                    ball.radius = r;
                }
                return certify(*solid, balls).holds;
            });
            bool open = true;
            for (Sphere& ball : balls) {
                ball.radius = radius;
                open = open && !inside(quad(at), ball);
            }
            EXPECT_FALSE(open) << "offset " << offset;
            EXPECT_LT(radius, distance(at, balls[0].center) + 1e-6);
        }
    }
}

TEST(CertificateAdversary, PinHoleOfANanometre) {
    for (const double hole : {1e-9, 1e-11}) {
        std::vector<Sphere> balls;
        for (int k = 0; k < 3; ++k) {
            const double angle = 2 * std::numbers::pi * k / 3 + 0.3;
            balls.push_back({Vec3{0.3, 0.2, 0.1} + 0.05 * Vec3{std::cos(angle), std::sin(angle), 0}, 0.05 - hole});
        }
        const auto solid = Solid::make(triangle(Vec3{0.28, 0.18, 0.1}, Vec3{0.32, 0.18, 0.1}, Vec3{0.3, 0.22, 0.1}));
        const Certificate missed = certify(*solid, balls);
        EXPECT_FALSE(missed.holds);
        EXPECT_NEAR(missed.growth, hole, 0.05 * hole + 1e-13);
        EXPECT_NEAR(distance(missed.witness, {0.3, 0.2, 0.1}), 0, 1e-6);
        EXPECT_EQ(missed.triangle, 0u);
    }
}

TEST(CertificateAdversary, PrimitivesAtHugeOffsetsAreJudgedWhereTheirPosePutsThem) {
    // The corners of a box in doubles are up to 1e-10 m off at 1000 km: a ball that holds only the rounded ones fails.
    Random random(3);
    const Vec3 size{0.2, 0.3, 0.4};
    for (const double offset : {0.0, 1e3, 1e6}) {
        for (int round = 0; round < 50; ++round) {
            const Pose pose = Pose::from_xyz_rpy(random_vector(random, offset), random_vector(random, 3));
            const auto solid = Solid::make({{nullptr, Element::box(size), pose}});
            const Vec3 center = pose * random_vector(random, 0.1);
            const double radius = test::smallest(0.1, 1, [&](double r) {
                return certify(*solid, std::vector<Sphere>{{center, r}}).holds;
            });
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 local{(corner & 1 ? 0.5 : -0.5) * size.x, (corner & 2 ? 0.5 : -0.5) * size.y,
                                 (corner & 4 ? 0.5 : -0.5) * size.z};
                EXPECT_TRUE(inside(placed(pose, local), {center, radius})) << "offset " << offset;
            }
        }
    }
}

TEST(CertificateAdversary, RoundPrimitivesAreNeverLeftOut) {
    // Points of the exact surface of a cylinder and a capsule, in quadruple arithmetic, against the least ball that
    // passes.
    Random random(4);
    for (const auto kind : {Element::Kind::cylinder, Element::Kind::capsule, Element::Kind::sphere}) {
        for (int round = 0; round < 5; ++round) {
            const Pose pose = Pose::from_xyz_rpy(random_vector(random, 1), random_vector(random, 3));
            const Element primitive = test::round_element(kind, 0.05, 0.2);
            const auto solid = Solid::make({{nullptr, primitive, pose}});
            const Vec3 center = pose * random_vector(random, 0.05);
            const double radius = test::smallest(0.01, 2, [&](double r) {
                return certify(*solid, std::vector<Sphere>{{center, r}}).holds;
            });
            const double half = kind == Element::Kind::sphere ? 0 : 0.1;
            for (int k = 0; k < 1000; ++k) {
                const double angle = random.uniform(0, 2 * std::numbers::pi), slope = random.uniform(0, 1.5707);
                const double end = k % 2 ? half : -half, cap = kind == Element::Kind::cylinder ? 0 : slope;
                const double r = 0.05 * (1 - 1e-15), z = end + (k % 2 ? r : -r) * std::sin(cap);
                const Vec3 local{r * std::cos(cap) * std::cos(angle), r * std::cos(cap) * std::sin(angle), z};
                EXPECT_TRUE(inside(placed(pose, local), {center, radius}));
            }
        }
    }
}

TEST(CertificateAdversary, RoundPrimitivesUnderSeveralBallsAreNeverLeftOut) {
    Random random(6);
    for (const auto kind : {Element::Kind::cylinder, Element::Kind::sphere}) {
        const Element primitive = test::round_element(kind, 0.1, 0.2);
        const auto solid = Solid::make({{nullptr, primitive, Pose{}}});
        for (int round = 0; round < 4; ++round) {
            std::vector<Sphere> balls;
            for (int k = 0; k < 4; ++k) {
                balls.push_back({random_vector(random, 0.06), 0});
            }
            const auto sized = [&](double radius) {
                for (Sphere& ball : balls) {
                    ball.radius = radius;
                }
                return balls;
            };
            sized(test::smallest(0.01, 2, [&](double r) { return certify(*solid, sized(r)).holds; }));
            for (int k = 0; k < 5000; ++k) {
                const double angle = random.uniform(0, 2 * std::numbers::pi), r = 0.1 * (1 - 1e-15);
                const double z = random.uniform(-r, r);
                const double across = kind == Element::Kind::sphere ? std::sqrt((r - z) * (r + z)) * (1 - 1e-15) : r;
                const QuadVec p = quad({across * std::cos(angle), across * std::sin(angle), z});
                EXPECT_TRUE(std::any_of(balls.begin(), balls.end(), [&](const Sphere& b) { return inside(p, b); }));
            }
        }
    }
}

/// Balls that cover the polyhedron around a primitive but not the point of the primitive beneath its outermost corner.
struct ShellTrick {
    std::vector<Sphere> balls;
    Vec3 open; ///< on the true surface, in none of the balls
};

ShellTrick cover_only_the_shell(const Element& primitive) {
    const auto beneath = [&](const Vec3& p) { // nearest point of the cylinder's or ball's surface
        const Vec3 axis{0, 0, primitive.kind == Element::Kind::cylinder ? p.z : 0};
        return axis + primitive.radius * normalized(p - axis);
    };
    Vec3 corner{};
    double depth = 0;
    for (Vec3 p : enclosing_mesh(primitive).vertices) {
        p.z = primitive.kind == Element::Kind::cylinder ? 0 : p.z; // in the middle of an edge
        if (norm(p) > 0 && distance(p, beneath(p)) > depth) {
            corner = p;
            depth = distance(p, beneath(p));
        }
    }
    ShellTrick trick{{{corner, 0.9 * depth}}, beneath(corner)};
    const Vec3 out = normalized(corner - trick.open), side = normalized(cross(out, {0, 0, 1})), up = cross(side, out);
    for (const Vec3& way : {side, -side, up, -up}) {
        trick.balls.push_back({corner + 0.5 * way, 0.5 - 0.45 * depth});
    }
    trick.balls.push_back({-corner, primitive.radius});
    return trick;
}

TEST(CertificateAdversary, CoverOfTheShellAroundARoundPrimitiveIsNoCover) {
    for (const Element& primitive :
         {Element::cylinder(0.1, 0.2), Element::sphere(0.1)}) {
        const ShellTrick trick = cover_only_the_shell(primitive);
        for (const Sphere& ball : trick.balls) {
            ASSERT_GT(distance(trick.open, ball.center), ball.radius * (1 + 1e-6));
        }
        const auto shell = Solid::make(enclosing_mesh(primitive));
        EXPECT_TRUE(certify(*as_surface(*shell), trick.balls).holds) << "the polyhedron itself is covered";
        const auto solid = Solid::make({{nullptr, primitive, Pose{}}});
        EXPECT_FALSE(certify(*solid, trick.balls).holds) << to_string(primitive.kind);
        const std::vector<Sphere> grown = grown_to_cover(*solid, trick.balls);
        EXPECT_TRUE(std::any_of(grown.begin(), grown.end(),
                                [&](const Sphere& ball) { return distance(trick.open, ball.center) <= ball.radius; }));
    }
}

TEST(CertificateAdversary, SquaresThatOverflowProveNothing) {
    // Both squares are infinite; infinity <= infinity is no proof.
    const double far = 1e170;
    const auto solid = Solid::make(triangle({far, 0, 0}, {0, far, 0}, {0, 0, far}));
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, 1e160}}).holds);
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, std::numeric_limits<double>::max()}}).holds)
        << "true, but not to be told from what is not";
    EXPECT_FALSE(certify(*Solid::make(triangle({1e308, 0, 0}, {0, 1e308, 0}, {-1e308, 0, 1e308})),
                         std::vector<Sphere>{{{}, 1e308}})
                     .holds);
}

TEST(CertificateAdversary, SquaresThatUnderflowProveNothing) {
    // Both squares are zero; 0 <= 0 is no proof.
    const double small = 1e-180;
    const auto solid = Solid::make(triangle({small, 0, 0}, {0, small, 0}, {0, 0, small}));
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, 1e-190}}).holds);
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, 0x1p-1074}}).holds) << "a subnormal radius";
    EXPECT_FALSE(certify(*Solid::make(triangle({0x1p-1074, 0, 0}, {0, 0x1p-1074, 0}, {0, 0, 0x1p-1074})),
                         std::vector<Sphere>{{{}, 0x1p-1074}})
                     .holds);
    EXPECT_TRUE(certify(*solid, std::vector<Sphere>{{{}, 1e-9}}).holds);
}

TEST(CertificateAdversary, SpheresOfNoSizeOrPlaceHoldNothing) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto point = Solid::make(triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
    for (const Sphere& s : {Sphere{{}, 0}, Sphere{{}, -1}, Sphere{{}, nan}, Sphere{{}, infinity}, Sphere{{}, -infinity},
                            Sphere{{nan, 0, 0}, 1}, Sphere{{0, infinity, 0}, infinity}}) {
        EXPECT_FALSE(certify(*point, std::vector<Sphere>{s}).holds) << s.center.x << " " << s.radius;
    }
    EXPECT_TRUE(certify(*point, std::vector<Sphere>{{{}, 1e-9}}).holds);
}

TEST(CertificateAdversary, DegenerateTrianglesCount) {
    // A segment and a point outside of the ball that holds all else.
    Mesh mesh = triangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0});
    mesh.vertices.push_back({0.3, 0, 0});
    mesh.triangles.push_back({0, 1, 3});
    EXPECT_FALSE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 0.2}}).holds);
    EXPECT_TRUE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 0.301}}).holds);
    mesh.triangles.back() = {3, 3, 3};
    const Certificate missed = certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 0.2}});
    EXPECT_FALSE(missed.holds);
    EXPECT_EQ(missed.triangle, 1u);
    EXPECT_EQ(missed.witness, (Vec3{0.3, 0, 0}));
}

TEST(CertificateAdversary, VerticesThatAreNoNumbersAreRefused) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        try {
            Solid::make(triangle({0, 0, 0}, {0.1, 0, 0}, {0, bad, 0}));
            FAIL() << "a solid was made";
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(), "vertex 2 in part 0 of the solid is not finite; repair the mesh or leave its "
                                       "triangles out");
        }
    }
}

TEST(CertificateAdversary, WhatGrowsToCoverIsProvedAtAllSizes) {
    for (const double size : {1e-150, 1e-100, 1e-9, 1e9, 1e100}) {
        const auto solid = Solid::make(triangle({size, 0, 0}, {0, size, 0}, {0, 0, size}));
        const std::vector<Sphere> grown = grown_to_cover(*solid, std::vector<Sphere>{{{}, 0}, {{size, 0, 0}, size / 2}});
        EXPECT_TRUE(certify(*solid, grown).holds) << size;
    }
}
