// foam::spherize() with Effort::fast, for objects in a loop, and the memory for objects that come again.
#include "cover/expect_cover.hpp"
#include "geometry/shapes.hpp"

#include <foam/base/parallel.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/sphere_cache.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

const CoverOptions fast{.effort = Effort::fast};

SphereCover on_threads(std::size_t threads, const Solid& solid, std::size_t count) {
    const ThreadLimit limit(threads);
    return spherize(solid, count, fast);
}

TEST(QuickCover, HoldsEverySampleOfTheContract) {
    for (const auto& [name, make] : sample::solids()) {
        const auto solid = make();
        for (const std::size_t count : {2, 8, 16, 40}) {
            SCOPED_TRACE(name + ", " + std::to_string(count));
            test::expect_cover(*solid, spherize(*solid, count, fast), count);
        }
    }
}

TEST(QuickCover, TheSameOnOneThreadAndOnFour) {
    const auto solid = sample::solids().at("Torus")();
    EXPECT_EQ(on_threads(1, *solid, 16).spheres, on_threads(4, *solid, 16).spheres);
}

TEST(QuickCover, IsNearlyAsGoodAsNormal) {
    const auto solid = sample::solids().at("Torus")();
    EXPECT_LE(spherize(*solid, 8, fast).volume, 1.1 * spherize(*solid, 8).volume);
}

TEST(QuickCover, EveryCornerOfASoupIsOnePoint) {
    const Mesh welded = sample::torus(0.1, 0.04, 24, 12);
    Mesh soup;
    for (const Triangle& t : welded.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const std::uint32_t corner : t) {
            soup.vertices.push_back(welded.vertices[corner]);
        }
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    EXPECT_EQ(spherize(soup, 6, fast).spheres, spherize(welded, 6, fast).spheres);
}

TEST(QuickCover, StoppedAtAnyTimeItIsCertified) {
    const auto solid = sample::solids().at("Torus")();
    for (int polls = 0; polls < 4; ++polls) {
        int asked = 0;
        const SphereCover cover = spherize(*solid, 8, {.effort = Effort::fast, .stop = [&] { return asked++ == polls; }});
        EXPECT_TRUE(certify(*solid, cover.spheres).holds) << polls;
    }
}

TEST(SphereCache, FindsAnObjectOnce) {
    SphereCache cache;
    const Mesh mesh = test::torus(1, 0.3);
    const auto first = cache.spherize(mesh, 4, fast);
    EXPECT_EQ(first->spheres, spherize(mesh, 4, fast).spheres);
    EXPECT_EQ(cache.spherize(mesh, 4, fast), first) << "the very same";
    EXPECT_EQ(cache.use().covers, 1u);
    EXPECT_EQ(cache.use().hits, 1u);
    EXPECT_EQ(cache.use().misses, 1u);
}

TEST(SphereCache, TellsQuestionsApart) {
    SphereCache cache;
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    const auto two = cache.spherize(mesh, 2, fast);
    EXPECT_NE(cache.spherize(mesh, 3, fast), two);
    EXPECT_NE(cache.spherize(mesh, 2, {.effort = Effort::fast, .seed = 1}), two);
    EXPECT_NE(cache.spherize(mesh, 2), two);
    mesh.vertices[0].x -= 1e-12;
    EXPECT_NE(cache.spherize(mesh, 2, fast), two);
    EXPECT_EQ(cache.use().hits, 0u);
    EXPECT_EQ(cache.use().covers, 5u);
}

TEST(SphereCache, ForgetsWhatWasUsedLongestAgo) {
    SphereCache cache(2);
    const Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    const auto one = cache.spherize(mesh, 1, fast);
    cache.spherize(mesh, 2, fast);
    EXPECT_EQ(cache.spherize(mesh, 1, fast), one);
    cache.spherize(mesh, 3, fast);
    EXPECT_EQ(cache.use().covers, 2u);
    EXPECT_EQ(cache.spherize(mesh, 1, fast), one) << "used after 2 was";
    const std::size_t misses = cache.use().misses;
    cache.spherize(mesh, 2, fast);
    EXPECT_EQ(cache.use().misses, misses + 1);
}

TEST(SphereCache, OfNoCapacityKeepsNothing) {
    SphereCache cache(0);
    const Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(cache.spherize(mesh, 1, fast)->certificate.holds);
    EXPECT_EQ(cache.use().covers, 0u);
}

TEST(SphereCache, KeepsNoSearchThatWasEnded) {
    SphereCache cache;
    const Mesh mesh = test::torus(1, 0.3);
    const auto ended = cache.spherize(mesh, 8, {.effort = Effort::fast, .stop = [] { return true; }});
    EXPECT_TRUE(ended->certificate.holds);
    EXPECT_EQ(cache.use().covers, 0u);
}

TEST(SphereCache, ServesThreads) {
    SphereCache cache;
    const Mesh mesh = test::box({0, 0, 0}, {1, 2, 3});
    std::vector<std::shared_ptr<const SphereCover>> covers(40);
    parallel_for(covers.size(), [&](std::size_t i) { covers[i] = cache.spherize(mesh, 1 + i % 4, fast); });
    for (std::size_t i = 0; i < covers.size(); ++i) {
        EXPECT_EQ(covers[i]->spheres, covers[i % 4]->spheres);
    }
    EXPECT_EQ(cache.use().covers, 4u);
}

} // namespace
