// Where the proof that two links touch ends: once both were seen, and when it is told to.
#include "collision/src/pairs.hpp"
#include "row_of_links.hpp"

#include <gmock/gmock.h>

namespace foam {
namespace {

using namespace collision::self_collision;
using test::Arm;
using ::testing::ElementsAre;
constexpr auto slides = Joint::Kind::prismatic;

/// The verdict about the first and the last link.
Verdict verdict(const Arm& arm, const Elements& first, const Elements& last, std::size_t boxes,
                const std::atomic<bool>* cancel = nullptr) {
    const Kinematics kinematics(arm.robot());
    const BallGroup a(first), b(last);
    const Chain chain = chain_between(kinematics, 0, arm.movers.size() + 2);
    return touching_verdict(kinematics, chain, a, b, boxes, cancel);
}

TEST(TouchingProof, BothWereSeen) {
    // Apart in the middle of the range, together at an end of it; and the other way round.
    EXPECT_EQ(verdict({{{slides, {}, {1, 0, 0}, -2, 2}}}, {{{}, 0.3}}, {{{1.2, 0, 0}, 0.3}}, 100), Verdict::some);
    EXPECT_EQ(verdict({{{slides, {}, {1, 0, 0}, -2, 2}}}, {{{}, 0.3}}, {{{0.1, 0, 0}, 0.3}}, 100), Verdict::some);
    const Element box{.kind = Element::Kind::box, .half = {0.3, 0.3, 0.3}};
    EXPECT_EQ(verdict({{{slides, {}, {1, 0, 0}, -2, 2}}}, {{{}, 0.3}}, {{{1.2, 0, 0}, 0.3}}, 1), Verdict::unknown);
    EXPECT_EQ(verdict({{{slides, {}, {1, 0, 0}, -2, 2}}}, Elements(std::vector<Element>{box}),
                      Elements(std::vector<Element>{box}), 100),
              Verdict::some);
}

TEST(TouchingProof, EndsWhenItIsTold) {
    const std::atomic<bool> yes = true, no = false;
    const Arm arm{{{slides, {}, {0, 1, 0}, -0.3, 0.3}}};
    EXPECT_EQ(verdict(arm, {{{}, 0.1}}, {{{1, 0, 0}, 0.1}}, 1, &yes), Verdict::unknown);
    EXPECT_EQ(verdict(arm, {{{}, 0.1}}, {{{1, 0, 0}, 0.1}}, 1, &no), Verdict::never);
}

TEST(TouchingProof, FreedomsAreSortedAndNamedOnce) {
    const Arm arm{{{slides, {}, {0, 1, 0}, -1, 1}, {slides, {}, {0, 1, 0}, -1, 1}, {slides, {}, {0, 1, 0}, -1, 1}}, 1};
    const Kinematics kinematics(arm.robot());
    EXPECT_THAT(freedoms_of(chain_between(kinematics, 1, 4)), ElementsAre(0, 1));
    EXPECT_THAT(freedoms_of(chain_between(kinematics, 4, 1)), ElementsAre(0, 1));
}

} // namespace
} // namespace foam
