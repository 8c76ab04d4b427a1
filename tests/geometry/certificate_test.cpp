// The proof of cover: it must hold where it can, and never where a point is uncovered.
#include "geometry/shapes.hpp"

#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// Distance to the union of the spheres, by looking at each.
double gap_at(const Vec3& p, const std::vector<Sphere>& spheres) {
    double gap = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) {
        gap = std::min(gap, distance(p, s.center) - s.radius);
    }
    return std::max(gap, 0.0);
}

} // namespace

TEST(Certificate, OneSphere) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double radius = std::sqrt(3.0);
    EXPECT_TRUE(certify(*cube, std::vector<Sphere>{{{}, radius + 1e-9}}).holds);
    const Certificate missed = certify(*cube, std::vector<Sphere>{{{}, radius - 1e-9}});
    EXPECT_FALSE(missed.holds);
    EXPECT_NEAR(missed.growth, 1e-9, 1e-11);
    EXPECT_NEAR(norm(missed.witness), radius, 1e-6);
    EXPECT_LT(missed.triangle, 12u);
}

TEST(Certificate, AnUlpTooSmallFails) {
    // The corners lie exactly on the sphere of radius 3: (1, 2, 2) and its likes.
    const auto solid = Solid::make(triangle({1, 2, 2}, {2, 1, 2}, {2, 2, 1}));
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, std::nextafter(3.0, 0.0)}}).holds);
    EXPECT_TRUE(certify(*solid, std::vector<Sphere>{{{}, 3 * (1 + 1e-12)}}).holds);
}

TEST(Certificate, SeveralSpheresTogether) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    std::vector<Sphere> spheres;
    for (int i = 0; i < 8; ++i) {
        spheres.push_back({{0.25 + 0.5 * i, 0.5, 0.5}, 0.75 + 1e-9});
    }
    EXPECT_TRUE(certify(*rod, spheres).holds) << "though the spheres meet exactly on the edges";
    spheres[3].radius = 0.7;
    const Certificate missed = certify(*rod, spheres);
    EXPECT_FALSE(missed.holds);
    EXPECT_GT(gap_at(missed.witness, spheres), 0);
    EXPECT_GE(missed.growth, gap_at(missed.witness, spheres));
}

TEST(Certificate, PinHole) {
    // Three discs in the plane whose common point is a hair outside all of them.
    const auto solid = Solid::make(triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0}));
    for (const double hole : {1e-3, 1e-6, 1e-9}) {
        std::vector<Sphere> spheres;
        for (int k = 0; k < 3; ++k) {
            const double angle = 2 * std::numbers::pi * k / 3 + 0.3;
            spheres.push_back({2 * Vec3{std::cos(angle), std::sin(angle), 0}, 2 - hole});
        }
        const Certificate missed = certify(*solid, spheres);
        EXPECT_FALSE(missed.holds) << hole;
        EXPECT_GE(missed.growth, hole * (1 - 1e-4));
        for (Sphere& s : spheres) {
            s.radius = 2 + hole;
        }
        EXPECT_TRUE(certify(*solid, spheres).holds) << hole;
    }
}

TEST(Certificate, OverlapsOfAHairTakeFewPieces) {
    // A strip under a row of balls, and the corners of a square under four that meet in its middle.
    const auto strip = Solid::make(box({0, 0, 0}, {8, 0.5, 0}));
    std::vector<Sphere> row, four;
    for (int i = 0; i < 8; ++i) {
        row.push_back({{i + 0.5, 0.25, 0}, std::hypot(0.5, 0.25) * (1 + 1e-9)});
    }
    const Certificate along = certify(*strip, row);
    EXPECT_TRUE(along.holds);
    EXPECT_LT(along.pieces, 400u) << "halving goes down to the width of the overlap";
    const auto square = Solid::make(box({-1, -1, 0}, {1, 1, 0}));
    for (int k = 0; k < 4; ++k) {
        four.push_back({{k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, 0}, std::sqrt(0.5) * (1 + 1e-9)});
    }
    const Certificate around = certify(*square, four);
    EXPECT_TRUE(around.holds);
    EXPECT_LT(around.pieces, 100u);
}

TEST(Certificate, GrowthIsTheGap) {
    Random random(4);
    for (int round = 0; round < 20; ++round) {
        const auto solid = Solid::make(torus(1, 0.3, 10));
        std::vector<Sphere> spheres;
        for (int i = 0; i < 8; ++i) {
            spheres.push_back({random_point(random, solid->bounds()), random.uniform(0.2, 0.8)});
        }
        double sampled = 0;
        for (const SurfacePoint& p : solid->sample_surface(20'000, 1)) {
            sampled = std::max(sampled, gap_at(p.point, spheres));
        }
        const Certificate certificate = certify(*solid, spheres);
        if (sampled > 0) {
            EXPECT_FALSE(certificate.holds);
            EXPECT_GE(certificate.growth, sampled);
            EXPECT_LE(certificate.growth, sampled * 1.05 + 0.01);
            EXPECT_GE(gap_at(certificate.witness, spheres), 0.998 * certificate.growth) << "the witness is the worst";
            for (Sphere& s : spheres) {
                s.radius += certificate.growth * (1 + 1e-9) + 1e-9;
            }
            EXPECT_TRUE(certify(*solid, spheres).holds) << "growth by so much closes everything";
        }
    }
}

TEST(Certificate, NeverPassesAnUncoveredSample) {
    // Spheres around a random cut of the surface, their radii around what just covers it.
    Random random(7);
    int held = 0;
    for (int round = 0; round < 200; ++round) {
        const Pose pose = random_pose(random, round % 2 ? 10'000 : 1);
        const auto solid = Solid::make(transformed(box({0, 0, 0}, {1, 0.2, 0.3}), pose));
        std::vector<Sphere> spheres;
        for (int i = 0; i < 4; ++i) {
            spheres.push_back({pose * Vec3{(i + 0.5) / 4, 0.1, 0.15}, 0.2195 + random.uniform(-1e-3, 1e-3)});
        }
        const bool holds = certify(*solid, spheres).holds;
        held += holds;
        for (const SurfacePoint& p : solid->sample_surface(2000, static_cast<std::uint64_t>(round))) {
            EXPECT_TRUE(!holds || gap_at(p.point, spheres) <= 1e-15 * norm(pose.translation));
        }
        for (const Vec3& v : solid->surface().vertices) {
            EXPECT_TRUE(!holds || gap_at(v, spheres) == 0);
        }
    }
    EXPECT_GT(held, 20);
    EXPECT_LT(held, 180);
}

TEST(Certificate, SpheresThatAreNone) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(certify(*cube, {}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, -5}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, 0}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, nan}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{nan, 0, 0}, 5}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{infinity, 0, 0}, infinity}}).holds);
    EXPECT_TRUE(certify(*cube, std::vector<Sphere>{{{nan, 0, 0}, 5}, {{}, 2}, {{}, nan}}).holds);
}

TEST(Certificate, SpheresOfNoUsableSizeHoldNoPoint) {
    const auto point = Solid::make(triangle({}, {}, {}));
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double radius : {1.001e-140, 0.999e150}) {
        EXPECT_TRUE(certify(*point, std::vector<Sphere>{{{}, radius}}).holds) << radius;
    }
    for (const double radius :
         {0.999e-140, 1.001e150, 0.0, -1.0, std::nan(""), infinity}) { // the square of -1 is positive
        EXPECT_FALSE(certify(*point, std::vector<Sphere>{{{}, radius}}).holds) << radius;
    }
}

TEST(Certificate, DegenerateTrianglesMustBeCoveredToo) {
    Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
    mesh.vertices.push_back({3, 0, 0});
    mesh.triangles.push_back({8, 8, 8});
    EXPECT_FALSE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 2}}).holds);
    EXPECT_TRUE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 2}, {{3, 0, 0}, 0.1}}).holds);
}

TEST(Certificate, SmallAndFarParts) {
    for (const double scale : {1e-7, 1.0}) {
        Pose pose;
        pose.translation = scale < 1 ? Vec3{} : Vec3{1e4, 0, 0};
        const auto solid = Solid::make(transformed(box({-1, -1, -1}, {1, 1, 1}), pose, {scale, scale, scale}));
        const double radius = std::sqrt(3.0) * scale;
        EXPECT_TRUE(certify(*solid, std::vector<Sphere>{{pose.translation, radius * (1 + 1e-10)}}).holds);
        EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{pose.translation, radius * (1 - 1e-10)}}).holds);
    }
}

TEST(Certificate, ASphereCoversItsPrimitive) {
    const Pose pose = Pose::from_xyz_rpy({0.1, 0.2, 0.3}, {0.4, 0.5, 0.6});
    const auto ball = primitive_solid(Element::sphere(0.25), pose);
    EXPECT_TRUE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.3}, 0.25}}).holds) << "proved in closed form";
    EXPECT_FALSE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.3}, std::nextafter(0.25, 0)}}).holds);
    EXPECT_TRUE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.4}, 0.35 + 1e-9}}).holds);
    EXPECT_FALSE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.4}, 0.35 - 1e-9}}).holds);
    const auto capsule = primitive_solid(Element::capsule(0.25, 1));
    EXPECT_TRUE(certify(*capsule, std::vector<Sphere>{{{}, 0.75 + 1e-9}}).holds);
    EXPECT_FALSE(certify(*capsule, std::vector<Sphere>{{{}, 0.75 - 1e-9}}).holds);
}

TEST(Certificate, RoundPartsInClosedForm) {
    // Such a part takes no pieces where one ball of the radius in closed form holds it, rounded up.
    const Pose pose = Pose::from_xyz_rpy({0.3, -0.2, 0.1}, {0.4, 0.5, 0.6});
    const Vec3 middle = pose.translation, away{0.1, 0.2, -0.3}, half = pose.rotate({0, 0, 0.2});
    const auto ball = primitive_solid(Element::sphere(0.2), pose),
               capsule = primitive_solid(Element::capsule(0.1, 0.4), pose);
    const auto held = [](const Solid& solid, const Vec3& center, double radius) {
        const Certificate certificate =
            certify(solid, std::vector<Sphere>{{center, radius}, {{std::nan(""), 0, 0}, 9}});
        EXPECT_EQ(certificate.holds, certificate.pieces == 0);
        return certificate.holds;
    };
    EXPECT_TRUE(held(*ball, middle, 0.2)) << "exact about the same centre";
    EXPECT_FALSE(held(*ball, middle, std::nextafter(0.2, 0)));
    const double around_ball = 0.2 + norm(away), farthest = std::max(norm(away - half), norm(away + half));
    for (const auto& [part, center, radius] :
         {std::tuple(&*ball, middle + away, around_ball), std::tuple(&*capsule, middle + away, 0.1 + farthest),
          std::tuple(&*capsule, middle, 0.3)}) { // only about a sphere's own centre is no rounding
        EXPECT_TRUE(held(*part, center, radius + 1e-12)) << radius;
        EXPECT_FALSE(held(*part, center, radius)) << radius;
        EXPECT_FALSE(held(*part, center, std::numeric_limits<double>::infinity())) << "not a ball";
    }
    // Boxes and cylinders are none.
    for (const Element& other : {Element::box({0.1, 0.1, 0.1}), Element::cylinder(0.1, 0.4)}) {
        EXPECT_GT(certify(*primitive_solid(other, pose), std::vector<Sphere>{{middle, 9}}).pieces, 0u);
    }
}

namespace {

/// Balls about a hole of this size in the origin, in the plane.
std::vector<Sphere> around_a_hole(double hole, const Vec3& at = {}, double turn = 0.3) {
    std::vector<Sphere> spheres;
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * std::numbers::pi * k / 3 + turn;
        spheres.push_back({at + 2 * Vec3{std::cos(angle), std::sin(angle), 0}, 2 - hole});
    }
    return spheres;
}

const Mesh small_triangle = triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});

} // namespace

TEST(Certificate, TellsWhatItTook) {
    const Mesh held = triangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}), cut = triangle({0, 0, 0}, {2, 0, 0}, {0, 0.2, 0});
    const std::vector<Sphere> two{{{0.5, 0.1, 0}, 0.7}, {{1.5, 0.1, 0}, 0.7}};
    const auto took = [&](const Mesh& mesh) { return geometry::prove_cover(*Solid::make(mesh), two); };
    EXPECT_EQ(took(held).certificate.pieces, 1u);
    EXPECT_EQ(took(held).halvings, 0u);
    EXPECT_EQ(took(cut).certificate.pieces, 3u);
    EXPECT_EQ(took(cut).halvings, 1u);
    for (const Mesh& both : {together(held, cut), together(cut, held)}) {
        EXPECT_TRUE(took(both).certificate.holds);
        EXPECT_EQ(took(both).certificate.pieces, 4u);
        EXPECT_EQ(took(both).halvings, 1u) << "of the piece that was cut most often";
        EXPECT_EQ(took(both).triangles, 2u);
    }
    EXPECT_EQ(took(together(together(cut, cut), held)).certificate.pieces, 7u);
    // Of two triangles one is cut more often.
    std::vector<Sphere> row;
    for (int i = 0; i < 4; ++i) {
        row.push_back({{i + 0.5, 0.1, 0}, 0.52});
    }
    const Mesh often = triangle({0, 0, 0}, {4, 0, 0}, {0, 0.2, 0}), once = triangle({0, 0, 0}, {2, 0, 0}, {0, 0.2, 0});
    const auto halvings = [&](const Mesh& mesh) { return geometry::prove_cover(*Solid::make(mesh), row).halvings; };
    EXPECT_EQ(halvings(once), 1u);
    EXPECT_EQ(halvings(often), 3u);
    EXPECT_EQ(halvings(together(often, once)), 3u);
    EXPECT_EQ(halvings(together(once, often)), 3u);
}

TEST(Certificate, ATriangleUnderARowIsCutOnceForEachPairOrLess) {
    const auto took = [](int count) {
        const auto solid = Solid::make(triangle({0, 0, 0}, {double(count), 0, 0}, {0, 1, 0}));
        const geometry::CoverProof proof = geometry::prove_cover(*solid, row_of_balls(count, 1.2));
        EXPECT_TRUE(proof.certificate.holds);
        return std::pair(proof.certificate.pieces - 1, proof.halvings);
    };
    EXPECT_EQ(took(1), std::pair(std::size_t{0}, 0u));
    EXPECT_EQ(took(2), std::pair(std::size_t{2}, 1u));
    const auto [pieces, cuts] = took(5);
    EXPECT_EQ(pieces, 6u) << "three cuts: balls hold more than their part";
    EXPECT_GE(cuts, 2u);
    EXPECT_LE(cuts, 4u);
}

TEST(Certificate, ManyCornersAreLeftToHalving) {
    // A ball about a corner of the triangle, and others in an arc before it: its part has a corner between any two.
    // Cuts take few pieces, halving takes thousands.
    for (const int around : {2, 5, 8, 9, 10, 11, 12, 16, 20}) {
        const double between = std::numbers::pi / 3 / around, radius = (1 + 1e-4) / std::cos(between / 2);
        std::vector<Sphere> spheres{{{0, 0, 0}, radius}};
        for (int k = 0; k < around; ++k) {
            const double angle = (k + 0.5) * between;
            spheres.push_back({2 * Vec3{std::cos(angle), std::sin(angle), 0}, radius});
        }
        const Vec3 a{0, 0, 0}, b{2.2, 0, 0}, c{1.1, 2.2 * std::sin(std::numbers::pi / 3), 0};
        int halved = 0;
        for (const Mesh& mesh : {triangle(a, b, c), triangle(b, c, a), triangle(c, a, b), triangle(a, c, b)}) {
            const Certificate certificate = certify(*Solid::make(mesh), spheres);
            EXPECT_TRUE(certificate.holds) << around;
            EXPECT_TRUE(certificate.pieces < 150 || certificate.pieces > 5'000) << certificate.pieces;
            halved += certificate.pieces > 150;
        }
        EXPECT_EQ(halved > 0, around > 10) << around;
    }
}

TEST(Certificate, SaysNoWhereAPartIsOpen) {
    // Each ball in turn is too small for its part.
    const auto solid = Solid::make(triangle({0, 0, 0}, {4, 0, 0}, {0, 1, 0}));
    const std::vector<Sphere> row = row_of_balls(4, 0.87);
    ASSERT_TRUE(certify(*solid, row).holds);
    for (std::size_t smaller = 0; smaller < 4; ++smaller) {
        std::vector<Sphere> spheres = row;
        spheres[smaller].radius = 0.2;
        EXPECT_FALSE(certify(*solid, spheres).holds) << smaller;
    }
    EXPECT_FALSE(certify(*solid, row_of_balls(4, 0.1)).holds);
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{}).holds) << "no balls";
}

TEST(Certificate, DepthIsOfHalvings) {
    // A row of balls over a long strip: its triangles are cut six times, which counts as twelve halvings.
    const auto strip = Solid::make(triangle({0, 0, 0}, {64, 0, 0}, {64, 0.1, 0}));
    std::vector<Sphere> row;
    for (int i = 0; i < 64; ++i) {
        row.push_back({{i + 0.5, 0.05, 0}, 0.51});
    }
    const std::uint32_t halvings = geometry::prove_cover(*strip, row).halvings;
    for (int depth = 0; depth < 12; ++depth) {
        EXPECT_EQ(certify(*strip, row, depth).holds, 3 * depth >= static_cast<int>(2 * halvings))
            << depth << " " << halvings;
    }
    // Where a part is open, its growth is that of pieces of the size to which it was halved.
    const auto solid = Solid::make(small_triangle);
    const std::vector<Sphere> spheres = around_a_hole(1e-3, {0.037, -0.113, 0});
    double whole = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) {
        double worst = 0;
        for (const Vec3& v : solid->surface().vertices) {
            worst = std::max(worst, distance(v, s.center) - s.radius);
        }
        whole = std::min(whole, worst);
    }
    EXPECT_NEAR(certify(*solid, spheres, 0).growth, whole, 1e-12) << "not halved";
    EXPECT_LT(certify(*solid, spheres, 1).growth, whole);
    for (int depth = 2; depth < 8; ++depth) {
        EXPECT_LT(certify(*solid, spheres, depth).growth, certify(*solid, spheres, depth - 2).growth) << depth;
    }
    EXPECT_EQ(certify(*solid, spheres, -5).growth, certify(*solid, spheres, 0).growth);
    EXPECT_EQ(certify(*solid, spheres, 61).growth, certify(*solid, spheres, 60).growth);
    for (const int depth : {0, 1, 2, 4}) {
        const geometry::CoverProof proof = geometry::prove_cover(*solid, spheres, depth);
        EXPECT_LE(proof.halvings, static_cast<std::uint32_t>(3 * depth));
        EXPECT_GE(proof.halvings, static_cast<std::uint32_t>(depth));
    }
}

TEST(Certificate, DepthSetsTheSlack) {
    // The least radius that passes is above the exact one by the slack of that depth.
    const auto solid = Solid::make(triangle({1, 2, 2}, {2, 1, 2}, {2, 2, 1}));
    const Vec3 middle = solid->bounds().center();
    double extent = 0;
    for (const Vec3& v : solid->surface().vertices) {
        extent = std::max(extent, distance(v, middle));
    }
    for (const int depth : {0, 20, 40, 60}) {
        double low = 3 - 1e-9, high = 3 + 1e-9;
        while (std::nextafter(low, high) < high) {
            const double at = low + (high - low) / 2;
            (certify(*solid, std::vector<Sphere>{{{}, at}}, depth).holds ? high : low) = at;
        }
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const double slack = epsilon * ((3 * depth + 8) * (extent + norm(middle) + 3) + 8 * norm(middle));
        EXPECT_NEAR(high - 3, slack, 3e-15) << depth;
    }
}

TEST(Certificate, TheGapIsFoundToAThousandth) {
    Random random(9);
    const auto solid = Solid::make(small_triangle);
    for (int round = 0; round < 150; ++round) {
        const double hole = std::pow(10, random.uniform(-6, -2));
        const Certificate missed = certify(
            *solid, around_a_hole(hole, {random.uniform(-0.1, 0.1), random.uniform(-0.3, 0), 0}, random.uniform(0, 2)));
        EXPECT_FALSE(missed.holds);
        EXPECT_GE(missed.growth, hole * (1 - 1e-9));
        EXPECT_LE(missed.growth, hole * 1.001 + 1e-14);
    }
}

TEST(Certificate, TheWorstOfSeveralHolesIsTold) {
    for (const bool first : {true, false}) {
        const Vec3 away{10, 0, 0};
        Mesh other = small_triangle;
        for (Vec3& v : other.vertices) {
            v += away;
        }
        std::vector<Sphere> spheres = around_a_hole(first ? 2e-3 : 1e-3);
        for (const Sphere& s : around_a_hole(first ? 1e-3 : 2e-3, away)) {
            spheres.push_back(s);
        }
        const Certificate missed = certify(*Solid::make(together(small_triangle, other)), spheres);
        EXPECT_NEAR(missed.growth, 2e-3, 3e-6);
        EXPECT_EQ(missed.triangle, first ? 0u : 1u);
        EXPECT_LT(distance(missed.witness, first ? Vec3{} : away), 1e-4);
    }
    // Corners far out, the near one first or last; what is covered beside them is not named.
    const Mesh near = triangle({0, 0, 0}, {0, 0, 2}, {0.1, 0, 0}), far = triangle({0, 0, 0}, {0, 3, 0}, {0.1, 0, 0}),
               held = triangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0});
    for (const Mesh& mesh : {together(together(near, far), held), together(together(far, near), held),
                             together(held, together(near, far))}) {
        const Certificate missed = certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 1}});
        EXPECT_NEAR(missed.growth, 2, 1e-9);
        EXPECT_EQ(missed.witness, (Vec3{0, 3, 0}));
        EXPECT_EQ(mesh.vertices[mesh.triangles[missed.triangle][1]], (Vec3{0, 3, 0}));
    }
}

TEST(Certificate, ARoundPartThatIsHeldLeavesTheOthersOpen) {
    // Each part in turn lacks its ball. Spheres and capsules are held in closed form, their tessellation is not.
    std::vector<Solid::Part> parts{
        {std::make_shared<const Mesh>(box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})), {}, {}},
        {nullptr, Element::sphere(0.2), Pose::from_xyz_rpy({1, 0, 0}, {})},
        {nullptr, Element::box({0.2, 0.2, 0.2}), Pose::from_xyz_rpy({2, 0, 0}, {})},
        {nullptr, Element::sphere(0.2), Pose::from_xyz_rpy({3, 0, 0}, {})},
        {nullptr, Element::cylinder(0.1, 0.2), Pose::from_xyz_rpy({4, 0, 0}, {})}};
    const auto solid = Solid::make(parts);
    std::vector<Sphere> all;
    for (int i = 0; i < 5; ++i) {
        all.push_back({{double(i), 0, 0}, 0.2});
    }
    const Certificate complete = certify(*solid, all);
    EXPECT_TRUE(complete.holds);
    std::size_t flat = solid->surface().triangles.size();
    for (const std::size_t part : {1, 3}) {
        flat -= solid->part_offsets()[part + 1] - solid->part_offsets()[part];
    }
    EXPECT_EQ(complete.pieces, flat) << "round parts are not looked at by pieces";
    for (std::size_t lacking = 0; lacking < 5; ++lacking) {
        std::vector<Sphere> spheres = all;
        spheres[lacking].radius = 0.05;
        const Certificate missed = certify(*solid, spheres);
        EXPECT_FALSE(missed.holds) << lacking;
        EXPECT_GE(missed.triangle, solid->part_offsets()[lacking]);
        EXPECT_LT(missed.triangle, solid->part_offsets()[lacking + 1]);
        EXPECT_GT(missed.growth, 0.05);
    }
}
