// Covering spheres of meshes of so many triangles that the search works on a coarse solid. The proof does not.
#include "cover/expect_cover.hpp"
#include "geometry/shapes.hpp"

#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/refine.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace foam;

const CoverOptions fast{.effort = Effort::fast};

/// 2 n² triangles.
Mesh fine_torus(std::uint32_t n = 250) {
    Mesh mesh = sample::torus(0.1, 0.04, n, n);
    EXPECT_GT(mesh.triangles.size(), geometry::many_triangles);
    return mesh;
}

/// A torus with thorns of one triangle, each thinner than a cell of the coarse solid.
Mesh with_thorns(Mesh mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 12'345) {
        const Vec3 a = mesh.vertices[mesh.triangles[t][0]], b = mesh.vertices[mesh.triangles[t][1]];
        append(mesh, {{a, b, a * 1.25}, {{0, 1, 2}}});
    }
    return mesh;
}

TEST(LargeMeshCover, HasACoarseSolidOfAFewVerticesOfItsOwn) {
    const auto solid = Solid::make(fine_torus());
    const auto coarse = geometry::coarse_solid(*solid);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(geometry::coarse_solid(*solid), coarse) << "made once";
    EXPECT_GT(coarse->surface().triangles.size(), 5'000u);
    EXPECT_LT(coarse->surface().triangles.size(), 40'000u);
    EXPECT_TRUE(coarse->closed());
    EXPECT_NEAR(coarse->volume(), solid->volume(), 0.02 * solid->volume());
    const auto& all = solid->surface().vertices;
    for (std::size_t i = 0; i < coarse->surface().vertices.size(); i += 100) {
        EXPECT_NE(std::find(all.begin(), all.end(), coarse->surface().vertices[i]), all.end());
    }
    EXPECT_FALSE(geometry::coarse_solid(*coarse)) << "it has few triangles";
    EXPECT_FALSE(geometry::coarse_solid(*Solid::make(sample::torus(0.1, 0.04, 200, 200))));
}

TEST(LargeMeshCover, KeepsPrimitivesAndPartsOfItsCoarseSolid) {
    const Element box = Element::box({0.1, 0.2, 0.3});
    const auto solid =
        Solid::make(std::vector<Solid::Part>{{std::make_shared<const Mesh>(fine_torus()), {}, {}}, {nullptr, box, {}}});
    const auto coarse = geometry::coarse_solid(*solid);
    ASSERT_TRUE(coarse);
    ASSERT_EQ(coarse->parts().size(), 2u);
    ASSERT_TRUE(coarse->parts()[1].primitive);
    EXPECT_EQ(coarse->parts()[1].primitive->half, box.half);
    test::expect_cover(*solid, spherize(*solid, 6, fast), 6);
}

TEST(LargeMeshCover, NoCoarseSolidWhereAllVerticesAreFarApart) {
    Random random(1);
    Mesh dust; // triangles of a lattice's size: most cells have one corner only
    for (std::uint32_t i = 0; i < 101'000; ++i) {
        const Vec3 a = test::random_point(random, {{0, 0, 0}, {1, 1, 1}});
        const Vec3 b = test::random_point(random, {{0, 0, 0}, {1e-9, 1e-9, 1e-9}});
        append(dust, {{a, a + b, a + Vec3{b.z, b.x, b.y}}, {{0, 1, 2}}});
    }
    const auto solid = Solid::make(dust);
    EXPECT_FALSE(geometry::coarse_solid(*solid)) << "nothing would be left";
    test::expect_cover(*solid, spherize(*solid, 2, fast), 2);
}

TEST(LargeMeshCover, IsProvedOnAllTriangles) {
    const auto solid = Solid::make(with_thorns(fine_torus()));
    ASSERT_TRUE(geometry::coarse_solid(*solid));
    for (const std::size_t count : {1, 2, 5, 9}) {
        test::expect_cover(*solid, spherize(*solid, count, fast), count);
    }
    test::expect_cover(*solid, spherize(*solid, 6), 6);
}

TEST(LargeMeshCover, IsNoWorseThanThatOfAFewTriangles) {
    const auto large = Solid::make(fine_torus()), small = Solid::make(sample::torus(0.1, 0.04, 120, 120));
    const std::size_t counts[]{2, 5, 8};
    for (const Effort effort : {Effort::fast, Effort::normal}) {
        const auto fine = spherize_each(*large, counts, {.effort = effort});
        const auto few = spherize_each(*small, counts, {.effort = effort});
        for (std::size_t i = 0; i < fine.size(); ++i) {
            EXPECT_LE(fine[i].volume, 1.02 * few[i].volume) << counts[i];
        }
    }
}

TEST(LargeMeshCover, MoreSpheresAreNeverWorse) {
    const auto solid = Solid::make(with_thorns(fine_torus()));
    const std::vector<std::size_t> counts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16};
    const std::vector<SphereCover> covers = spherize_each(*solid, counts, fast);
    for (std::size_t i = 1; i < covers.size(); ++i) {
        EXPECT_LE(geometry::joint_volume(*solid, covers[i].spheres),
                  geometry::joint_volume(*solid, covers[i - 1].spheres))
            << counts[i];
    }
    CoverSearch alone(*solid, fast);
    EXPECT_EQ(alone.cover(16).elements.spheres(), covers.back().spheres) << "whatever was requested before";
}

TEST(LargeMeshCover, StoppedAtAnyTimeItIsCertified) {
    const auto solid = Solid::make(fine_torus());
    for (int polls = 0; polls < 3; ++polls) {
        int asked = 0;
        const CoverOptions stopped{.stop = [&] { return asked++ >= polls; }};
        EXPECT_TRUE(certify(*solid, spherize(*solid, 8, stopped).spheres).holds) << polls;
        asked = 0;
        CoverSearch search(*solid, stopped);
        EXPECT_TRUE(certify(*solid, search.cover(5).elements).holds) << polls;
    }
}

TEST(LargeMeshCover, OtherObjectivesSearchOnTheSolidItself) {
    const auto solid = Solid::make(sample::torus(0.1, 0.04, 225, 225));
    ASSERT_TRUE(geometry::coarse_solid(*solid));
    const SphereCover cover = spherize(*solid, 4, {.effort = Effort::fast, .objective = Objective::radius});
    test::expect_cover(*solid, cover, 4);
    const SphereCover excess = spherize(*solid, 4, fast);
    const auto largest = [](const SphereCover& c) {
        return std::max_element(c.spheres.begin(), c.spheres.end(),
                                [](const Sphere& a, const Sphere& b) { return a.radius < b.radius; })
            ->radius;
    };
    EXPECT_LE(largest(cover), largest(excess));
}

TEST(LargeMeshCover, SplitsLookAtTheCoarseSolidAndGrowToCover) {
    const auto solid = Solid::make(fine_torus());
    const SphereCover five = spherize(*solid, 5, fast);
    by_spheres::Splitting splitting(*solid);
    const by_spheres::Claim six = splitting.one_more(five.spheres, geometry::joint_volume(*solid, five.spheres));
    ASSERT_EQ(six.spheres.size(), 6u);
    const std::vector<Sphere> grown = grown_to_cover(*solid, six.spheres);
    EXPECT_TRUE(certify(*solid, grown).holds);
    EXPECT_LT(geometry::joint_volume(*solid, grown), geometry::joint_volume(*solid, five.spheres));
}

} // namespace
