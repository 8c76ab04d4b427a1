// Covers that grow by a sphere at a time.
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/refine.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

class EverySolid : public testing::TestWithParam<std::string> {};

/// Their faces are larger than the later spheres: what lies far from a sphere is held by others that do not meet it.
TEST_P(EverySolid, IsHeldByEverMoreSpheresThatClaimEverLess) {
    const auto solid = sample::solids().at(GetParam())();
    by_spheres::Splitting splitting(*solid);
    std::vector<Sphere> cover{minimum_enclosing_sphere(solid->surface().vertices)};
    cover = grown_to_cover(*solid, cover);
    const double alone = exact_union_volume(cover);
    double claimed = alone;
    for (std::size_t count = 2; count <= 16; ++count) {
        const auto [more, volume] = splitting.one_more(cover, geometry::joint_volume(*solid, cover));
        ASSERT_EQ(more.size(), count);
        EXPECT_EQ(volume, geometry::joint_volume(*solid, more)) << count;
        const std::vector<Sphere> closed = grown_to_cover(*solid, more);
        EXPECT_LT(exact_union_volume(closed), exact_union_volume(more) * (1 + 1e-6)) << count;
        if (GetParam() != "Torus" || count > 3) { // two claim more than one around a ring
            EXPECT_LT(exact_union_volume(more), claimed) << count;
        }
        claimed = exact_union_volume(more);
        cover = more;
    }
    EXPECT_LT(claimed - solid->volume(), 0.4 * (alone - solid->volume()));
}

INSTANTIATE_TEST_SUITE_P(Splitting, EverySolid, testing::Values("Box", "Bracket", "TwoBoxes"),
                         [](const auto& test) { return test.param; });

} // namespace
