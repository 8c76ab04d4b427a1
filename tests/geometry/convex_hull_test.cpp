// Convex hulls: every point inside, every vertex a vertex, degenerate input.
#include "plain_shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/element.hpp>
#include <foam/geometry/internal/quickhull.hpp>

#include <gtest/gtest.h>

#include <set>

using namespace foam;

namespace {

/// How far the points are outside of the faces, in extended precision.
long double most_outside(const Polytope& hull, const std::vector<Vec3>& points) {
    long double most = -std::numeric_limits<long double>::infinity();
    for (const Polytope::Face& face : hull.faces) {
        const long double x = face.normal.x, y = face.normal.y, z = face.normal.z;
        for (const Vec3& p : points) {
            most = std::max(most, x * p.x + y * p.y + z * p.z - face.offset);
        }
    }
    return most;
}

/// Checks what element.hpp promises of a hull, to a share of its size and its distance from the origin.
void expect_hull_of(const std::vector<Vec3>& points, double tolerance = 1e-13) {
    const auto hull = convex_hull(points);
    Box box;
    double away = 0;
    for (const Vec3& p : points) {
        box.add(p);
        away = std::max({away, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const double rounding = 4 * tolerance * away;
    EXPECT_LE(most_outside(*hull, points), 0);
    const Topology t = topology(hull->surface);
    EXPECT_TRUE(t.closed_manifold()) << describe(t);
    if (std::abs(std::log10(away)) < 50) { // areas neither overflow nor vanish
        EXPECT_EQ(t.degenerate_triangles, 0u);
    }
    EXPECT_EQ(t.components, 1u);
    std::set<std::array<double, 3>> given;
    for (const Vec3& p : points) {
        given.insert({p.x, p.y, p.z});
    }
    for (const Vec3& v : hull->surface.vertices) {
        EXPECT_TRUE(given.count({v.x, v.y, v.z})) << "a vertex is not one of the points";
    }
    for (const Polytope::Face& face : hull->faces) {
        EXPECT_NEAR(norm(face.normal), 1, 1e-15);
        double highest = -std::numeric_limits<double>::infinity();
        for (const Vec3& v : hull->surface.vertices) {
            highest = std::max(highest, dot(face.normal, v) - face.offset);
        }
        EXPECT_GE(highest, -rounding) << "the face does not touch the hull";
    }
    for (const Triangle& t : hull->surface.triangles) { // in a face, or so thin that it is near others
        const std::vector<Vec3>& v = hull->surface.vertices;
        const Vec3 middle = v[t[0]] / 3 + v[t[1]] / 3 + v[t[2]] / 3;
        double inside = std::numeric_limits<double>::infinity();
        for (const Polytope::Face& face : hull->faces) {
            inside = std::min(inside, face.offset - dot(face.normal, middle));
        }
        EXPECT_LE(inside, rounding + 1e-8 * box.diagonal()) << "a face is missing"; // slivers may lean
    }
    const double all = signed_volume(hull->surface);
    if (std::abs(std::log10(box.diagonal())) < 50) {
        EXPECT_GT(all, 0);
    }
    if (all > 0 && std::isfinite(all) && points.size() < 200) { // each vertex is needed
        for (std::size_t i = 0; i < hull->surface.vertices.size() && hull->surface.vertices.size() > 4; ++i) {
            std::vector<Vec3> fewer = hull->surface.vertices;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
            try {
                EXPECT_LT(signed_volume(convex_hull(fewer)->surface), all);
            } catch (const Error&) { // what is left is flat
            }
        }
    }
}

std::vector<Vec3> random_points(Random& random, std::size_t count, const Box& box) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back(test::random_point(random, box));
    }
    return points;
}

std::vector<Vec3> moved(std::vector<Vec3> points, const Pose& pose) {
    for (Vec3& p : points) {
        p = pose * p;
    }
    return points;
}

/// Points of a lattice: many lie in the faces and on the edges.
std::vector<Vec3> lattice(int n) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) {
            for (int j = 0; j <= n; ++j) {
                points.push_back({i / double(n), k / double(n), j / double(n)});
            }
        }
    }
    return points;
}

const Box unit{{0, 0, 0}, {1, 1, 1}};

TEST(ConvexHull, RandomPoints) {
    Random random(1);
    for (int run = 0; run < 60; ++run) {
        expect_hull_of(random_points(random, 4 + random.below(60), unit));
    }
    expect_hull_of(random_points(random, 20'000, unit));
}

TEST(ConvexHull, PointsOnABall) {
    Random random(2);
    std::vector<Vec3> points;
    for (int i = 0; i < 3'000; ++i) {
        points.push_back(test::random_direction(random));
    }
    expect_hull_of(points);
    EXPECT_EQ(convex_hull(points)->surface.vertices.size(), 3'000u);
}

TEST(ConvexHull, FacesAndEdgesOfALatticeAreMerged) {
    const std::vector<Vec3> points = lattice(9);
    expect_hull_of(points);
    const auto hull = convex_hull(points);
    EXPECT_EQ(hull->surface.vertices.size(), 8u);
    EXPECT_EQ(hull->faces.size(), 6u);
    Random random(3);
    for (int run = 0; run < 20; ++run) { // rounding puts the points beside their planes
        const std::vector<Vec3> turned = moved(points, test::random_pose(random, run % 2 ? 100 : 0));
        expect_hull_of(turned);
        EXPECT_EQ(convex_hull(turned)->surface.vertices.size(), 8u);
        EXPECT_EQ(convex_hull(turned)->faces.size(), 6u);
    }
    for (int k = 0; k < 6; ++k) { // far away along one axis, to either side
        Pose away = Pose::from_xyz_rpy({}, {1, 2, 3});
        away.translation[k % 3] = k < 3 ? 1000 : -1000;
        const auto far = convex_hull(moved(points, away));
        EXPECT_EQ(far->surface.vertices.size(), 8u);
        EXPECT_EQ(far->faces.size(), 6u);
    }
}

TEST(ConvexHull, DuplicatesChangeNothing) {
    Random random(4);
    std::vector<Vec3> points = random_points(random, 40, unit);
    const Polytope once = *convex_hull(points);
    const std::vector<Vec3> copy = points;
    for (int i = 0; i < 3; ++i) {
        points.insert(points.end(), copy.begin(), copy.end());
    }
    expect_hull_of(points);
    EXPECT_EQ(convex_hull(points)->surface.vertices.size(), once.surface.vertices.size());
}

TEST(ConvexHull, RoundShapes) {
    Random random(5);
    for (const Element::Kind kind : {Element::Kind::cylinder, Element::Kind::capsule, Element::Kind::sphere}) {
        for (const int segments : {3, 16, 64}) {
            const Mesh mesh = enclosing_mesh(test::round_element(kind, 0.5, 2), segments);
            expect_hull_of(mesh.vertices);
            expect_hull_of(moved(mesh.vertices, test::random_pose(random, 1)));
        }
    }
    const Mesh cylinder = enclosing_mesh(Element::cylinder(0.5, 2), 16);
    EXPECT_EQ(convex_hull(cylinder.vertices)->surface.vertices.size(), 32u);
    EXPECT_EQ(convex_hull(cylinder.vertices)->faces.size(), 18u);
}

TEST(ConvexHull, ThinNeedlesAndPlates) {
    Random random(6);
    for (const double thin : {1e-3, 1e-6, 1e-9, 1e-12}) {
        for (int run = 0; run < 10; ++run) {
            const Pose pose = test::random_pose(random, 0);
            expect_hull_of(moved(random_points(random, 50, {{0, 0, 0}, {1, 1, thin}}), pose));
            if (thin > 1e-8) {
                expect_hull_of(moved(random_points(random, 50, {{0, 0, 0}, {1, thin, thin}}), pose));
            }
        }
    }
}

TEST(ConvexHull, AnySizeAndPlace) {
    Random random(7);
    for (const double size : {1e-300, 1e-100, 1e-9, 1e9, 1e100, 1e150}) {
        std::vector<Vec3> points = random_points(random, 50, unit);
        for (Vec3& p : points) {
            p *= size;
        }
        expect_hull_of(points);
    }
    for (const double away : {1e3, 1e6, 1e9}) {
        expect_hull_of(random_points(random, 50, {{away, -away, away}, {away + 1, 1 - away, away + 1}}));
    }
}

TEST(ConvexHull, NearlyFlatNoiseOnAllFaces) {
    Random random(8);
    for (const double noise : {1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-8}) {
        std::vector<Vec3> points = lattice(8);
        for (Vec3& p : points) {
            p += test::random_direction(random) * noise;
        }
        expect_hull_of(moved(points, test::random_pose(random, 0)));
    }
}

TEST(ConvexHull, FacesOfPrismsPyramidsAndFrusta) {
    // Polygons and triangles side by side; each has as many faces and corners as it has, at any place.
    Random random(10);
    const auto ring = [](int n, double radius, double z) {
        std::vector<Vec3> points;
        for (int k = 0; k < n; ++k) {
            const double angle = 2 * std::numbers::pi * k / n;
            points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
        return points;
    };
    for (const int n : {3, 4, 5, 12}) {
        for (const double top : {0.0, 0.5, 1.0}) {
            std::vector<Vec3> points = ring(n, 1, 0);
            const std::vector<Vec3> upper = top > 0 ? ring(n, top, 0.7) : std::vector<Vec3>{{0, 0, 0.7}};
            points.insert(points.end(), upper.begin(), upper.end());
            points.push_back({0.1, 0.1, 0}); // within a face
            points.push_back((points[0] + points[1]) * 0.5); // and on an edge
            for (const double away : {0.0, 10.0}) {
                const std::vector<Vec3> turned = moved(points, test::random_pose(random, away));
                expect_hull_of(turned);
                const auto hull = convex_hull(turned);
                EXPECT_EQ(hull->faces.size(), static_cast<std::size_t>(n + (top > 0 ? 2 : 1)));
                EXPECT_EQ(hull->surface.vertices.size(), static_cast<std::size_t>(top > 0 ? 2 * n : n + 1));
                for (const Polytope::Face& face : hull->faces) { // the offset is that of the corners, to some roundings
                    double highest = -std::numeric_limits<double>::infinity();
                    for (const Vec3& p : turned) {
                        highest = std::max(highest, dot(face.normal, p));
                    }
                    EXPECT_NEAR(face.offset, highest, 64 * 0x1p-53 * (away + 4));
                }
            }
        }
    }
}

TEST(ConvexHull, PointsJustOutsideOfAFaceAreContained) {
    // Beside a face by less than rounding they need be no corners, but the plane is above them. The faces meet at the
    // origin, where there is the least room.
    Random random(12);
    for (int run = 0; run < 100; ++run) {
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k) {
            points.push_back({k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0});
        }
        std::rotate(points.begin(), points.begin() + run % 8, points.end());
        const double beside = random.uniform(2.8e-15, 3.8e-15);
        points.insert(points.end(), {{0.5, 0.5, -beside}, {0.5, -beside, 0.5}, {-beside, 0.5, 0.5}});
        expect_hull_of(moved(points, test::random_pose(random, 0)));
    }
}

TEST(ConvexHull, APointBesideAFaceIsACornerAboveTheTolerance) {
    // 16 roundings of the size, which is a thousandth more than the diagonal, and 4 of the largest coordinate: 31.74.
    for (const double roundings : {31.0, 31.71, 31.76, 32.0}) {
        const double beside = roundings * 0x1p-53;
        for (int run = 0; run < 8; ++run) {
            std::vector<Vec3> points;
            for (int k = 0; k < 8; ++k) {
                points.push_back({k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0});
            }
            std::rotate(points.begin(), points.begin() + run, points.end());
            points.push_back({0.4, 0.3, -beside});
            EXPECT_EQ(convex_hull(points)->surface.vertices.size(), roundings > 31.74 ? 9u : 8u) << run;
            EXPECT_LE(most_outside(*convex_hull(points), points), 0);
        }
    }
}

TEST(ConvexHull, WhatIsNearlyFlatOrALine) {
    // Merging gives polygons of two corners, or fewer than four faces.
    Random random(18);
    for (int run = 0; run < 2000; ++run) {
        std::vector<Vec3> points = run % 2 ? lattice(1 + static_cast<int>(random.below(3)))
                                           : random_points(random, 4 + random.below(20), unit);
        const bool line = run % 8 < 6; // across a line by about the rounding: there it happens
        const double along = line ? 1e-6 : 1, across = std::pow(10, random.uniform(-16, line ? -14.3 : -9));
        const double noise = std::pow(10, random.uniform(-17, -14));
        for (Vec3& p : points) {
            p = Vec3{p.x, along * p.y, across * p.z} + test::random_direction(random) * noise;
        }
        try {
            const std::vector<Vec3> turned = moved(points, test::random_pose(random, 0));
            const auto hull = convex_hull(turned);
            EXPECT_LE(most_outside(*hull, turned), 0);
            const Topology t = topology(hull->surface);
            EXPECT_TRUE(t.closed_manifold()) << describe(t);
            EXPECT_EQ(t.components, 1u);
            EXPECT_LE(hull->faces.size(), hull->surface.triangles.size()) << "each face has a triangle";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::geometry);
        }
    }
}

TEST(ConvexHull, WhereAFacetPassesACornerTwiceOrHasAHoleTheTrianglesAreTheFacets) {
    // Nearly on a line; found by trying a hundred thousand.
    const std::vector<std::vector<Vec3>> all{{{-0x1.1476bf5fe77fcp-1, -0x1.e4b8fc20d4437p-1, -0x1.3bdaecb59a63cp+0},
                                              {-0x1.2df3f3ba778cbp+0, -0x1.02e2725e01bcp+0, -0x1.692078fc587d5p+0},
                                              {-0x1.c2f8ad7f6e32ap-3, -0x1.d43307bd063bap-1, -0x1.253826835b57dp+0},
                                              {-0x1.c2f8ad7f6e312p-3, -0x1.d43307bd0639bp-1, -0x1.253826835b56fp+0},
                                              {-0x1.b82f536423628p-1, -0x1.f53ef07bbfbb8p-1, -0x1.527db2e1e63fp+0},
                                              {-0x1.2df3f3bc8f85ep+0, -0x1.02e272599072ep+0, -0x1.692078f6654a8p+0},
                                              {-0x1.2df3f3bc8f86cp+0, -0x1.02e2725990714p+0, -0x1.692078f6654b8p+0},
                                              {-0x1.2df3f3bc8f858p+0, -0x1.02e2725990736p+0, -0x1.692078f6654b2p+0},
                                              {-0x1.c2f8ad4d2ef23p-3, -0x1.d43307d7adf1fp-1, -0x1.2538269534f0cp+0},
                                              {-0x1.2df3f3b85f94ap+0, -0x1.02e2726273055p+0, -0x1.692079024bb0cp+0}},
                                             {{0x1.9a667796a5348p-2, 0x1.f9644ba96b2ep-4, -0x1.91ca94bc6c902p-1},
                                              {0x1.544b27c9889b1p-2, 0x1.28ac47f987308p-3, 0x1.b38e52d640698p-3},
                                              {0x1.544b27c987278p-2, 0x1.28ac47f986f82p-3, 0x1.b38e52d64037bp-3},
                                              {0x1.88dfa3a35f062p-2, 0x1.07b0ae5dea1c9p-3, -0x1.121f0a5fed5d2p-1},
                                              {0x1.544b27c9889b4p-2, 0x1.28ac47f9872bap-3, 0x1.b38e52d64069ep-3},
                                              {0x1.9a667796a7248p-2, 0x1.f9644ba96bb26p-4, -0x1.91ca94bc6c7f4p-1},
                                              {0x1.9a667796a5347p-2, 0x1.f9644ba96b3aep-4, -0x1.91ca94bc6c904p-1},
                                              {0x1.88dfa3a35f821p-2, 0x1.07b0ae5dea2d2p-3, -0x1.121f0a5fed59p-1},
                                              {0x1.88dfa3a35d924p-2, 0x1.07b0ae5de9eafp-3, -0x1.121f0a5fed69ap-1},
                                              {0x1.544b27c9881f8p-2, 0x1.28ac47f987194p-3, 0x1.b38e52d640593p-3},
                                              {0x1.544b27c986ab6p-2, 0x1.28ac47f986e7bp-3, 0x1.b38e52d64026fp-3}}};
    for (const std::vector<Vec3>& points : all) {
        const auto hull = convex_hull(points);
        EXPECT_LE(most_outside(*hull, points), 0);
        const Topology t = topology(hull->surface);
        EXPECT_TRUE(t.closed_manifold()) << describe(t);
        EXPECT_EQ(hull->faces.size(), hull->surface.triangles.size());
    }
}

TEST(ConvexHull, APointFarOutsideOfTheNextTriangleButOneIsACorner) {
    // Points nearly on a line, and one beside it: new triangles are so thin that their planes do not tell.
    const std::vector<std::vector<Vec3>> all{{{-0x1.0e1c50379173fp-5, -0x1.9d0d62fa506d6p-2, -0x1.bf22e5d7957f7p-2},
                                              {-0x1.30976ca19679cp-6, -0x1.d2ef921fa6f0ap-3, -0x1.f9ce1109a5d3bp-3},
                                              {-0x1.b202d3eb7c21fp-5, -0x1.4bf8bc7ea3dep-1, -0x1.67670706e2e1fp-1},
                                              {-0x1.035363321d9f2p-6, -0x1.8e0871a2b33d3p-3, -0x1.af4f3aa65123cp-3},
                                              {-0x1.b828b0ea4c616p-6, -0x1.5132196c2b41p-2, -0x1.6d3607d35c61bp-2},
                                              {0.3, 0.3, 1}},
                                             {{0x1.b9a7e16470546p-4, -0x1.9bcbe906be0cfp-4, -0x1.5e09e7c566947p-5},
                                              {0x1.2b4f8254fd391p-2, -0x1.1730485fda1d8p-2, -0x1.da7a86f8abaf1p-4},
                                              {0x1.1aefa42015b69p-1, -0x1.07f14eb262056p-1, -0x1.c087a04b62118p-3},
                                              {0x1.453ba6625f67ap-1, -0x1.2f647b886e792p-1, -0x1.01ca2965b6039p-2},
                                              {0x1.4877dfdd910d1p-1, -0x1.32649ea4d2367p-1, -0x1.0459f0e874283p-2},
                                              {0.3, 0.3, 1}},
                                             {{0x1.bf814f83c921ep-2, 0x1.3381794413b1cp-4, -0x1.2de47bf9710f5p-1},
                                              {0x1.69e7d1b1d0618p-3, 0x1.f15f85cdc6755p-6, -0x1.e84ad3bf8dbebp-3},
                                              {0x1.2ab970d77d857p-1, 0x1.9a8af5f85ae4dp-4, -0x1.930bf73843943p-1},
                                              {0x1.c22d0b588a859p-6, 0x1.355e6ebeced65p-8, -0x1.2fb2def031f2ep-5},
                                              {0x1.2987670fabe1bp-1, 0x1.98e5e435ad8f9p-4, -0x1.916ef9bde6d44p-1},
                                              {0.3, 0.3, 1}},
                                             {{-0x1.8c500fab2d9aep-52, -0x1.046eed66eeaf8p-55, -0x1.32720dbb96fc4p-54},
                                              {-0x1.22e1fa550361ap-5, -0x1.57cf4f9ea3d4bp-5, -0x1.f377b454859bp-3},
                                              {-0x1.22ea700a16bd8p-3, -0x1.57c1a083bd92p-3, -0x1.f377fc2bc8761p-1},
                                              {-0x1.999865c24a1bp-55, -0x1.367b019bb0ccp-52, 0x1.5ba0a2445f17bp-52},
                                              {0x1.4d2f8cd3a579p-20, -0x1.0d783918d4656p-19, 0x1.61ad97eb2b0c9p-23},
                                              {-0x1.22ec63d169facp-5, -0x1.57be781b1249p-5, -0x1.f3780cbfeb94cp-3}},
                                             {{0x1.5fb1a5e5e5bdap-2, -0x1.7e301379bc17p-4, 0x1.f15f978950485p-4},
                                              {0x1.759fb2b69601ap-1, -0x1.961c7c570fee1p-3, 0x1.083cb5a54c566p-2},
                                              {0x1.036d773991223p-2, -0x1.19e8d150127d6p-4, 0x1.6ee07f6373214p-4},
                                              {0x1.e0f8b7dbbfa7cp-3, -0x1.05549eb59854bp-4, 0x1.5418104a781abp-4},
                                              {0x1.83e578ebe083ep-2, -0x1.a585740ce4d3dp-4, 0x1.124838f65349dp-3},
                                              {0x1.3e95f907183b9p-2, -0x1.5a66e10b01ed9p-4, 0x1.c2bbcc34ae67ap-4},
                                              {0x1.02ba41bf22ecp-5, -0x1.1bbd59d153822p-7, 0x1.70566d424007fp-7},
                                              {0.3, 0.3, 1}}};
    for (const std::vector<Vec3>& points : all) {
        expect_hull_of(points);
    }
}

TEST(ConvexHull, PlanesOfFewCornersAreAboveThemByRoundingAlone) {
    Random random(19);
    for (int run = 0; run < 50; ++run) {
        const std::vector<Vec3> cube =
            moved(test::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).vertices, test::random_pose(random, 0));
        const auto hull = convex_hull(cube);
        for (const Polytope::Face& face : hull->faces) {
            double highest = -std::numeric_limits<double>::infinity();
            for (const Vec3& p : cube) {
                highest = std::max(highest, dot(face.normal, p));
            }
            EXPECT_LE(face.offset - highest,
                      16 * 0x1p-53 * (1.5 + 3.01) + 4 * 0x1p-53); // lengths along the axes, a box's diagonal
        }
    }
}

TEST(ConvexHull, RefusesWhatHasNoHull) {
    const auto message = [](std::vector<Vec3> points) -> std::string {
        try {
            convex_hull(points);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::geometry);
            return error.what();
        }
        return "no error";
    };
    const std::string flat = "a convex hull needs four points that do not lie in a plane";
    EXPECT_EQ(message({}), flat);
    EXPECT_EQ(message({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), flat);
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), flat);
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}), flat);
    Random random(9);
    for (int run = 0; run < 20; ++run) {
        EXPECT_EQ(message(moved(random_points(random, 30, {{0, 0, 0}, {1, 1, 0}}), test::random_pose(random, 1))),
                  flat);
    }
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::infinity()}}),
              "a convex hull needs points with finite coordinates");
}

TEST(FarthestPoint, IsThatOfAllPoints) {
    Random random(7);
    const auto direction = [&] {
        return normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    };
    for (const std::size_t count : {0u, 1u, 8u, 9u, 1000u}) {
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < count; ++i) {
            points.push_back(i % 3 == 0 ? Vec3{0.5, 0.25, 0} : direction()); // some of them the same
        }
        const FarthestPoint farthest(points);
        for (int k = 0; k < 100; ++k) {
            const Vec3 normal = direction(), at = direction();
            double most = -0.25;
            for (const Vec3& p : points) {
                most = std::max(most, dot(normal, p - at));
            }
            EXPECT_EQ(farthest.above(normal, at, -0.25), most);
        }
    }
}

} // namespace
