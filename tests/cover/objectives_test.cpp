// Objectives of foam::spherize() other than excess: proved, never worse than excess by their own measure, never worse
// with more spheres.
#include "cover/expect_cover.hpp"
#include "geometry/shapes.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/sphere_cache.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

const std::map<std::string, Objective> objectives{{"protrusion", Objective::protrusion}, {"radius", Objective::radius}};

class ByObjective : public testing::TestWithParam<std::string> {
protected:
    double figure(const Solid& solid, const std::vector<Sphere>& spheres) const {
        if (objective == Objective::protrusion) {
            return geometry::protrusion(solid, spheres, MeasureOptions{}.directions_per_sphere).max;
        }
        double largest = 0;
        for (const Sphere& sphere : spheres) {
            largest = std::max(largest, sphere.radius);
        }
        return largest;
    }

    const Objective objective = objectives.at(GetParam());
    const CoverOptions fast{.effort = Effort::fast, .objective = objective};
};

INSTANTIATE_TEST_SUITE_P(Objectives, ByObjective, testing::Values("protrusion", "radius"),
                         [](const auto& test) { return test.param; });

TEST_P(ByObjective, EverySampleOfTheContractIsHeldAndNoWorseThanByExcess) {
    for (const auto& [name, make] : sample::solids()) {
        const auto solid = make();
        for (const std::size_t count : {1, 2, 5, 12}) {
            SCOPED_TRACE(name + ", " + std::to_string(count));
            const SphereCover cover = spherize(*solid, count, fast);
            test::expect_cover(*solid, cover, count);
            const SphereCover by_excess = spherize(*solid, count, {.effort = Effort::fast});
            EXPECT_LE(figure(*solid, cover.spheres), figure(*solid, by_excess.spheres));
        }
    }
}

TEST_P(ByObjective, IsClearlyBetterThanByExcess) {
    const auto solid = sample::solids().at("Bracket")();
    const SphereCover cover = spherize(*solid, 10, {.objective = objective});
    EXPECT_LT(figure(*solid, cover.spheres), 0.95 * figure(*solid, spherize(*solid, 10).spheres));
}

TEST_P(ByObjective, MoreSpheresAreNeverWorseNorWorseThanByExcess) {
    const std::vector<std::size_t> counts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16};
    for (const char* name : {"Bracket", "Torus"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        const std::vector<SphereCover> by_excess = spherize_each(*solid, counts, {.effort = Effort::fast});
        double least = std::numeric_limits<double>::infinity();
        std::size_t i = 0;
        for (const SphereCover& cover : spherize_each(*solid, counts, fast)) {
            SCOPED_TRACE(counts[i]);
            EXPECT_TRUE(cover.certificate.holds);
            EXPECT_LE(cover.spheres.size(), counts[i]);
            const double here = figure(*solid, cover.spheres);
            EXPECT_LE(here, least);
            EXPECT_LE(here, figure(*solid, by_excess[i++].spheres));
            least = here;
        }
    }
}

TEST_P(ByObjective, MoreEffortIsProvedToo) {
    const auto solid = sample::solids().at("Bracket")();
    for (const Effort effort : {Effort::normal, Effort::best}) {
        const SphereCover cover = spherize(*solid, 3, {.effort = effort, .objective = objective});
        EXPECT_TRUE(certify(*solid, cover.spheres).holds);
        EXPECT_LE(figure(*solid, cover.spheres), figure(*solid, spherize(*solid, 3, {.effort = effort}).spheres));
    }
}

TEST_P(ByObjective, TheSameOnOneThreadAndOnFour) {
    const auto solid = sample::solids().at("Torus")();
    const auto on_threads = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        return spherize(*solid, 7, {.objective = objective}).spheres;
    };
    EXPECT_EQ(on_threads(1), on_threads(4));
}

TEST_P(ByObjective, ASearchGivesTheSameWhateverWasAskedBefore) {
    const auto solid = sample::solids().at("Bracket")();
    CoverSearch search(*solid, fast);
    for (const std::size_t count : {7, 3, 13, 7}) {
        EXPECT_EQ(search.cover(count).elements.spheres(), spherize_each(*solid, {&count, 1}, fast)[0].spheres) << count;
    }
}

TEST_P(ByObjective, StoppedAtAnyTimeItIsCertified) {
    const auto solid = sample::solids().at("Bracket")();
    for (const int polls : {0, 1, 3, 6, 12, 24}) {
        SCOPED_TRACE(polls);
        int asked = 0;
        const SphereCover cover = spherize(*solid, 6, {.objective = objective, .stop = [&] { return asked++ >= polls; }});
        EXPECT_TRUE(certify(*solid, cover.spheres).holds);
        EXPECT_LE(cover.spheres.size(), 6u);
    }
}

TEST_P(ByObjective, NeverStoppedItIsAsIfNobodyAsked) {
    const auto solid = sample::solids().at("Bracket")();
    EXPECT_EQ(spherize(*solid, 4, {.objective = objective, .stop = [] { return false; }}).spheres,
              spherize(*solid, 4, {.objective = objective}).spheres);
}

TEST_P(ByObjective, NastyMeshes) {
    Mesh open = test::box({0, 0, 0}, {1, 1, 1});
    open.triangles.resize(open.triangles.size() - 3);
    const std::map<std::string, Mesh> meshes{
        {"plate", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}},
        {"thin plate", test::box({0, 0, 0}, {1, 1, 1e-5})},
        {"point", {{{1, 2, 3}}, {{0, 0, 0}}}},
        {"far away", transformed(sample::bracket(), {.translation = {1e5, -1e5, 1e5}}, {1, 1, 1})},
        {"open box", open},
        {"inside out", test::flipped(sample::bracket())},
    };
    for (const auto& [name, mesh] : meshes) {
        SCOPED_TRACE(name);
        const auto solid = Solid::make(mesh);
        for (const std::size_t count : {1, 2, 7}) {
            const SphereCover cover = spherize(*solid, count, fast);
            EXPECT_TRUE(certify(*solid, cover.spheres).holds);
            EXPECT_LE(cover.spheres.size(), count);
        }
    }
}

TEST(Objectives, TheCacheTellsThemApart) {
    SphereCache cache;
    const Mesh mesh = sample::bracket();
    for (const Objective objective : {Objective::excess, Objective::protrusion, Objective::radius}) {
        const CoverOptions options{.effort = Effort::fast, .objective = objective};
        EXPECT_EQ(cache.spherize(mesh, 5, options)->spheres, spherize(mesh, 5, options).spheres);
    }
    EXPECT_EQ(cache.use().misses, 3u);
}

} // namespace
