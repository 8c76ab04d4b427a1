// foam::spherize() with hundreds of spheres.
#include "cover/expect_cover.hpp"

#include <foam/base/parallel.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/spherize.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

const CoverOptions fast{.effort = Effort::fast};

std::shared_ptr<const Solid> torus() {
    return sample::solids().at("Torus")();
}

std::shared_ptr<const Solid> bracket() {
    return sample::solids().at("Bracket")();
}

double excess_of(const Solid& solid, const SphereCover& cover) {
    return cover.volume / solid.volume() - 1;
}

TEST(ManyCover, HoldsEverySampleOfTheContract) {
    for (const auto& [name, make] : sample::solids()) {
        const auto solid = make();
        for (const std::size_t count : {17, 80}) {
            SCOPED_TRACE(name + ", " + std::to_string(count));
            test::expect_cover(*solid, spherize(*solid, count, fast), count);
        }
    }
}

TEST(ManyCover, NormalHoldsTooAndIsNoWorseThanSixtyFour) {
    const auto solid = bracket();
    const std::array<std::size_t, 3> counts{64, 65, 120};
    const std::vector<SphereCover> covers = spherize_each(*solid, counts);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        test::expect_cover(*solid, covers[i], counts[i]);
        EXPECT_LE(covers[i].volume, covers.front().volume * (1 + 1e-9));
    }
    EXPECT_LT(excess_of(*solid, covers[2]), 0.8 * excess_of(*solid, covers[0]));
}

TEST(ManyCover, ExcessFallsAsTheNumberGrows) {
    const auto solid = bracket();
    const double some = excess_of(*solid, spherize(*solid, 50, fast));
    const double more = excess_of(*solid, spherize(*solid, 200, fast));
    EXPECT_LT(more, 0.5 * some);
}

TEST(ManyCover, FastIsNearlyAsGoodAsNormal) {
    const auto solid = bracket();
    EXPECT_LE(excess_of(*solid, spherize(*solid, 64, fast)), 1.15 * excess_of(*solid, spherize(*solid, 64)));
}

TEST(ManyCover, FastAlongItsCountsIsNeverWorse) {
    const auto solid = torus();
    const std::array<std::size_t, 6> counts{14, 16, 32, 48, 64, 100};
    const std::vector<SphereCover> covers = spherize_each(*solid, counts, fast);
    for (std::size_t i = 1; i < counts.size(); ++i) {
        EXPECT_LE(covers[i].volume, covers[counts[i] == 64 ? 2 : i - 1].volume * (1 + 1e-9)) << counts[i];
    }
}

TEST(ManyCover, TheSameOnOneThreadAndOnFour) {
    const auto solid = torus();
    const auto on_threads = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        return spherize(*solid, 100, fast).spheres;
    };
    EXPECT_EQ(on_threads(1), on_threads(4));
}

TEST(ManyCover, StoppedAtAnyTimeItIsCertified) {
    const auto solid = torus();
    for (const Effort effort : {Effort::fast, Effort::normal}) {
        for (int polls = 0; polls < 8; polls += 1 + polls / 2) {
            int asked = 0;
            const CoverOptions options{.effort = effort, .stop = [&] { return asked++ >= polls; }};
            SCOPED_TRACE(polls);
            test::expect_cover(*solid, spherize(*solid, 80, options), 80);
        }
    }
}

} // namespace
