// The proof that two links touch always, or never: its bounds are exact where a single joint moves, and no sample
// contradicts it.
#include "geometry/plain_shapes.hpp"
#include "row_of_links.hpp"

#include <foam/collision/self_collision.hpp>
#include <foam/collision/separation.hpp>

#include <gmock/gmock.h>

#include <numbers>

namespace foam::test {
namespace {

using std::numbers::pi;
constexpr auto slides = Joint::Kind::prismatic, turns = Joint::Kind::revolute;

enum class Verdict { never, always, unknown };

/// What is proved of the first and the last link, without samples, with so many boxes.
Verdict verdict(const Arm& arm, const Elements& first, const Elements& last, std::size_t boxes) {
    const std::shared_ptr<const Robot> robot = arm.robot();
    std::vector<Elements> elements(robot->links.size());
    elements.front() = first;
    elements[1] = Elements(std::vector<Sphere>{{{1e3, 1e3, 1e3}, 0.1}}); // geometry in between: they are no neighbours
    elements.back() = last;
    CollisionModel model{robot, elements, {}, {}};
    model.sources.assign(elements.size(), CollisionModel::Source::geometry);
    const SelfCollisionMatrix matrix =
        self_collision_matrix(Kinematics(robot), model, {.samples = 0, .proof_boxes = boxes});
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.first == 0 && pair.second + 1 == elements.size()) {
            return !pair.proved ? Verdict::unknown : pair.reason == PairReason::never ? Verdict::never : Verdict::always;
        }
    }
    throw std::out_of_range("no such pair");
}

/// Expects that one box is enough where links move by less than the limit, and not where they move by more.
template <class Of> void expect_limit(double limit, Verdict below, Of&& of) {
    EXPECT_EQ(of(limit - 2e-9), below) << limit;
    EXPECT_EQ(of(limit - 0.5e-9), Verdict::unknown) << limit << ": room for rounding";
    EXPECT_EQ(of(limit + 2e-9), Verdict::unknown) << limit;
}

TEST(TouchingProof, ASliderMovesByItsRange) {
    expect_limit(0.8, Verdict::never, [](double half) {
        return verdict({{{slides, {0, 5, 0}, {0, 1, 0}, -5 - half, -5 + half}}}, {{{}, 0.1}}, {{{1, 0, 0}, 0.1}}, 1);
    });
    expect_limit(0.5, Verdict::always, [](double half) {
        return verdict({{{slides, {0, 5, 0}, {0, 1, 0}, -5 - half, -5 + half}}}, {{{}, 0.3}}, {{{0.1, 0, 0}, 0.3}}, 1);
    });
}

TEST(TouchingProof, AHingeMovesByItsChord) {
    expect_limit(1.8, Verdict::never, [](double move) {
        const double half = 2 * std::asin(move / 2);
        return verdict({{{turns, {}, {0, 0, 1}, 1 - half, 1 + half}}}, {{{3 * std::cos(1), 3 * std::sin(1), 0}, 0.1}},
                       {{{1, 0, 0}, 0.1}}, 1);
    });
    // Half a turn is the most.
    const auto wide = [](double at) {
        return verdict({{{turns, {}, {0, 0, 1}, -4, 4}}}, {{{at, 0, 0}, 0.1}}, {{{1, 0, 0}, 0.1}}, 1);
    };
    EXPECT_EQ(wide(3.2 + 2e-9), Verdict::never);
    EXPECT_EQ(wide(3.2 - 2e-9), Verdict::unknown);
}

TEST(TouchingProof, AMimicMovesByItsMultiplier) {
    for (const double multiplier : {3, -3}) {
        expect_limit(0.8, Verdict::never, [&](double move) { // once by the joint itself, three times by the other
            const double half = move / 4;
            return verdict({{{slides, {}, {0, 1, 0}, -half, half}, {slides, {}, {0, 0, 1}, 0, 0}}, multiplier},
                           {{{}, 0.1}}, {{{1, 0, 0}, 0.1}}, 1);
        });
    }
}

TEST(TouchingProof, LaterJointsAddToTheReachOfEarlierOnes) {
    // A hinge, and a slider upon it; the base is far out and large, so that it is not moved instead.
    const double chord = 2 * std::sin(0.15);
    const auto hinge_first = [&](double slide) {
        return verdict({{{turns, {}, {0, 0, 1}, -0.3, 0.3}, {slides, {}, {1, 0, 0}, -slide, slide}}}, {{{10, 0, 0}, 8}},
                       {{{1, 0, 0}, 0.1}}, 1);
    };
    const double room = 10 - 8 - 1 - 0.1; // = slide + chord (1 + slide)
    expect_limit((room - chord) / (1 + chord), Verdict::never, hinge_first);
    const auto slider_first = [&](double slide) {
        return verdict({{{slides, {}, {0, 1, 0}, -slide, slide}, {turns, {}, {0, 0, 1}, -0.3, 0.3}}}, {{{10, 0, 0}, 8}},
                       {{{1, 0, 0}, 0.1}}, 1);
    };
    expect_limit(room - chord, Verdict::never, slider_first);
}

TEST(TouchingProof, AnElementMovesAsTheBallAroundIt) {
    // Not by the chord of its middle alone: a bar that turns about its own middle, beside a ball within its reach. The
    // frame is that of the link that moves less.
    const Element bar{.kind = Element::Kind::capsule, .half = {0, 0, 1}, .radius = 0.1};
    const double reach = minimum_enclosing_sphere(enclosing_mesh(bar).vertices).radius;
    for (const double at : {0.8, 1.05}) {
        const std::vector<Sphere> ball{{{at, 0, 0}, 0.1}};
        const double arm = std::min(reach, at + 0.1);
        for (const bool swapped : {false, true}) {
            expect_limit(at - 0.2, Verdict::never, [&](double move) {
                const double half = 2 * std::asin(move / arm / 2);
                const Arm turning{{{turns, {}, {0, 1, 0}, -half, half}}};
                const Elements balls{ball}, bars{std::span(&bar, 1)};
                return swapped ? verdict(turning, balls, bars, 1) : verdict(turning, bars, balls, 1);
            });
        }
    }
}

TEST(TouchingProof, BallsAroundLinksKeepWhatTurnsAboutItsMiddle) {
    // Two balls that turn about the point between them stay in the ball around both, which does not move: what is beside
    // that ball is never touched, though each of them moves by more than the gap. The balls around the links overlap.
    const std::vector<Sphere> turning{{{0.9, 0, 0}, 0.1}, {{-0.9, 0, 0}, 0.1}};
    const auto beside = [](double x) { return std::vector<Sphere>{{{x, 1.5, 0}, 0.1}, {{x, -1.5, 0}, 0.1}}; };
    const Arm arm{{{turns, {}, {0, 0, 1}, -2, 2}}};
    EXPECT_EQ(verdict(arm, turning, beside(0.5), 1), Verdict::never);
    EXPECT_EQ(verdict(arm, beside(0.5), turning, 1), Verdict::never);
    // The limit is the ball around both, with room for rounding.
    for (const bool swapped : {false, true}) {
        for (const auto& [room, expected] : {std::pair{2e-9, Verdict::never}, {0.5e-9, Verdict::unknown}}) {
            const double y = std::sqrt((1.1 + room) * (1.1 + room) - 0.3 * 0.3);
            const std::vector<Sphere> near{{{0.3, y, 0}, 0.1}, {{0.3, -y, 0}, 0.1}};
            EXPECT_EQ(swapped ? verdict(arm, near, turning, 1) : verdict(arm, turning, near, 1), expected) << room;
        }
    }
}

TEST(TouchingProof, AllPairsOfElementsAreCompared) {
    // The balls around the links overlap; each pair of elements in turn decides alone.
    Random random(5);
    int never = 0, always = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Sphere> first, second;
        std::vector<Element> first_boxes, second_boxes;
        const auto fill = [&](std::vector<Sphere>& balls, std::vector<Element>& boxes) {
            for (int k = 0; k < 3; ++k) {
                const Vec3 at = test::random_direction(random) * random.uniform(0, 1.5);
                const double size = random.uniform(0.05, 0.3);
                if (random.below(3) == 0) {
                    boxes.push_back({.kind = Element::Kind::box, .pose = Pose::from_xyz_rpy(at, {}),
                                     .half = {size, size, size}});
                } else {
                    balls.push_back({at, size});
                }
            }
        };
        fill(first, first_boxes);
        fill(second, second_boxes);
        const double half = random.uniform(0, 0.1);
        const Arm arm{{{slides, {}, {0, 0, 1}, -half, half}}};
        // A slider moves all by the same length: the least gap and the largest depth decide.
        bool apart = true, deep = false, near = false;
        const auto as_elements = [](const std::vector<Sphere>& balls, std::vector<Element> all) {
            for (const Sphere& ball : balls) {
                all.push_back(element_of(ball));
            }
            return all;
        };
        for (const Element& a : as_elements(first, first_boxes)) {
            for (const Element& b : as_elements(second, second_boxes)) {
                const Separation between = separation(a, b);
                apart = apart && between.low > half + 1e-9;
                deep = deep || between.depth > half + 1e-9;
                near = near || std::abs(between.low + between.depth - half - 1e-9) < 1e-6;
            }
        }
        if (near) {
            continue; // the bound on boxes is not exact
        }
        const Verdict found = verdict(arm, Elements{first, first_boxes}, Elements{second, second_boxes}, 1);
        EXPECT_EQ(found == Verdict::never, apart) << round;
        EXPECT_EQ(found == Verdict::always, deep) << round;
        never += apart;
        always += deep;
    }
    EXPECT_GT(never, 50);
    EXPECT_GT(always, 50);
}

TEST(TouchingProof, TheFrameIsThatOfTheLinkThatMovesLeast) {
    // Two balls on a line with hinges; each is moved by the hinges between it and the link whose frame is taken.
    const double half = 0.05, chord = 2 * std::sin(half / 2);
    const auto expect_moves = [&](const std::vector<double>& hinges_before, const std::vector<double>& hinges_behind,
                                  double moves) {
        expect_limit(moves, Verdict::never, [&](double allowed) { // the gap grows where less is allowed
            const double gap = 2 * moves - allowed;
            std::vector<double> places;
            for (const double x : hinges_before) {
                places.push_back(-x);
            }
            for (const double x : hinges_behind) {
                places.push_back(0.2 + gap + x);
            }
            Arm arm;
            double before = 0;
            for (const double x : places) {
                arm.movers.push_back({turns, {x - before, 0, 0}, {0, 0, 1}, -half, half});
                before = x;
            }
            return verdict(arm, {{{}, 0.1}}, {{{0.2 + gap - before, 0, 0}, 0.1}}, 1);
        });
    };
    expect_moves({1}, {}, chord);                            // that of the last link
    expect_moves({}, {1}, chord);                            // that of the first one
    expect_moves({1}, {1}, 2 * chord);                       // that of the one in the middle
    expect_moves({1, 1.5}, {1}, chord * (1 + 1.5 + 1 + chord)); // nearer to the last one
}

TEST(TouchingProof, ElementsThatTouchDeeplyTouchAlways) {
    const Element box{.kind = Element::Kind::box, .half = {1, 1, 1}};
    const std::vector<Sphere> ball{{{}, 0.5}};
    for (const bool swapped : {false, true}) {
        const auto moved_by = [&](double half) {
            const Arm arm{{{slides, {}, {0, 1, 0}, -half, half}}};
            const Elements boxes{std::span(&box, 1)}, balls{ball, {}};
            return swapped ? verdict(arm, balls, boxes, 1) : verdict(arm, boxes, balls, 1);
        };
        EXPECT_EQ(moved_by(0.4), Verdict::always);
        EXPECT_EQ(moved_by(1.6), Verdict::unknown);
    }
    const auto two_boxes = [&](double half) {
        const Arm arm{{{slides, {}, {0, 1, 0}, -half, half}}};
        return verdict(arm, Elements(std::vector<Element>{box}), Elements(std::vector<Element>{box}), 1);
    };
    EXPECT_EQ(two_boxes(0.9), Verdict::always);
    EXPECT_EQ(two_boxes(2.1), Verdict::unknown);
}

TEST(TouchingProof, OneOfManyElementsDecides) {
    // Any element that touches deeply makes the links touch; all of them have to be apart.
    const std::vector<Sphere> deep{{{5, 0, 0}, 0.1}, {{}, 0.5}, {{0, 0, 3}, 0.1}},
        far{{{9, 0, 0}, 0.1}, {{9, 9, 0}, 0.1}};
    const std::vector<Sphere> last{{{0, 0, 9}, 0.1}, {{0.1, 0, 0}, 0.5}, {{0, 9, 9}, 0.1}};
    const Arm arm{{{slides, {}, {0, 1, 0}, -0.3, 0.3}}};
    EXPECT_EQ(verdict(arm, deep, last, 1), Verdict::always);
    EXPECT_EQ(verdict(arm, last, deep, 1), Verdict::always);
    EXPECT_EQ(verdict(arm, far, last, 1), Verdict::never);
    const Element box{.kind = Element::Kind::box, .half = {0.5, 0.5, 0.5}};
    Element away = box;
    away.pose.translation = {0, 0, 4};
    const std::vector<Element> boxes{away, box, away};
    EXPECT_EQ(verdict(arm, Elements(boxes), Elements(last), 1), Verdict::always);
    EXPECT_EQ(verdict(arm, Elements(last), Elements(boxes), 1), Verdict::always);
    EXPECT_EQ(verdict(arm, Elements(far), Elements(boxes), 1), Verdict::never);
}

TEST(TouchingProof, NoJointMovesOneConfiguration) {
    const auto rigid = [](double at) {
        return verdict({{{slides, {}, {1, 0, 0}, 0.5, 0.5}}}, {{{}, 0.3}}, {{{at, 0, 0}, 0.3}}, 1);
    };
    EXPECT_EQ(rigid(0), Verdict::always);
    EXPECT_EQ(rigid(0.5), Verdict::never);
    const std::vector<Sphere> one{{{}, 0.1}}, two{{{0.1, 0, 0}, 0.1}};
    EXPECT_EQ(verdict(Arm{}, one, two, 1), Verdict::always);
    const std::vector<Sphere> beside{{{0.25, 0, 0}, 0.125}}, middle{{{}, 0.125}}; // have one point in common
    EXPECT_EQ(verdict(Arm{}, middle, beside, 9), Verdict::always);
}

/// A slider along y, and a ball that passes another with little room.
struct Passing {
    double half, room;

    std::vector<Sphere> ball() const { return {{{0.2 + room, 0, 0}, 0.1}}; }
    /// The boxes that halving takes.
    std::size_t boxes(double low, double high) const {
        const double middle = (low + high) / 2;
        const bool apart = std::hypot(0.2 + room, middle) - 0.2 > (high - low) / 2 + 1e-9;
        return apart ? 1 : 1 + boxes(low, middle) + boxes(middle, high);
    }
    std::size_t boxes() const { return boxes(-half, half); }
    Verdict verdict_within(std::size_t boxes) const {
        return verdict({{{slides, {}, {0, 1, 0}, -half, half}}}, {{{}, 0.1}}, ball(), boxes);
    }
};

TEST(TouchingProof, TakesAsManyBoxesAsTheBoundsAsk) {
    for (const Passing& passing : {Passing{1, 0.03}, Passing{3.1, 0.01}, Passing{0.5, 0.002}}) {
        const std::size_t needed = passing.boxes();
        ASSERT_GT(needed, 15u);
        ASSERT_LT(needed, 512u);
        EXPECT_EQ(passing.verdict_within(needed), Verdict::never) << needed;
        EXPECT_EQ(passing.verdict_within(needed - 1), Verdict::unknown) << needed;
    }
}

TEST(TouchingProof, HalvesTheJointThatMovesMost) {
    // Beside the far one the near slider matters little: to halve it would double the boxes for nothing.
    const Passing passing{3, 0.03};
    for (const bool first : {false, true}) {
        Arm arm{{{slides, {}, {0, 1, 0}, -3, 3}, {slides, {}, {0, 0, 1}, -0.001, 0.001}}};
        if (first) {
            std::swap(arm.movers[0], arm.movers[1]);
        }
        EXPECT_EQ(verdict(arm, {{{}, 0.1}}, passing.ball(), passing.boxes() * 5 / 4), Verdict::never);
    }
}

TEST(TouchingProof, EndsEarlyWhereNothingIsDecided) {
    // The balls just touch in every position: no box can be decided, and a thousand million are not looked at.
    EXPECT_EQ(verdict({{{turns, {}, {0, 0, 1}, -3, 3}, {turns, {}, {0, 0, 1}, -3, 3}}}, {{{}, 0.5}}, {{{1, 0, 0}, 0.5}},
                      1'000'000'000),
              Verdict::unknown);
    // Where boxes are decided all the time, it goes on beyond the first hundreds.
    const Passing passing{0.5, 3e-6};
    ASSERT_GT(passing.boxes(), 1000u);
    EXPECT_EQ(passing.verdict_within(2 * passing.boxes()), Verdict::never);
}

TEST(TouchingProof, EndsEarlyWhereLittleIsDecided) {
    // They just touch in every position, and a little more at one end of the range: boxes of a ten-thousandth of it.
    const Vec3 end{1.5 * std::cos(-3), 1.5 * std::sin(-3), 0};
    EXPECT_EQ(verdict({{{turns, {}, {0, 0, 1}, -3, 3}}}, {{{}, 0.5}, {end, 1e-7}}, {{{1, 0, 0}, 0.5}}, 100'000'000),
              Verdict::unknown);
}

std::vector<Element> random_elements(Random& random, double size) {
    std::vector<Element> elements;
    for (const auto kind : {Element::Kind::box, Element::Kind::capsule, Element::Kind::cylinder}) {
        Element e{.kind = kind, .pose = test::random_pose(random, size)};
        const auto length = [&] { return size * random.uniform(0.1, 0.5); };
        e.half = kind == Element::Kind::box ? Vec3{length(), length(), length()} : Vec3{0, 0, length()};
        e.radius = kind == Element::Kind::box ? 0 : length();
        elements.push_back(e);
    }
    return elements;
}

/// How many of some random configurations have the first and the last link apart for certain, and touching.
std::pair<int, int> seen(const Arm& arm, const std::vector<Element>& first, const std::vector<Element>& last,
                         Random& random) {
    const Kinematics kinematics(arm.robot());
    std::pair<int, int> result;
    for (int k = 0; k < 200; ++k) {
        const Pose pose = kinematics.link_poses(kinematics.random_configuration(random)).back();
        bool apart = true, touching = false;
        for (const Element& a : first) {
            for (const Element& b : last) {
                const Separation between = separation(a, b, {}, pose);
                apart = apart && between.low > 1e-6;
                touching = touching || between.depth > 1e-6;
            }
        }
        result.first += apart;
        result.second += touching;
    }
    return result;
}

TEST(TouchingProof, NoSampleContradictsIt) {
    Random random(3);
    int never = 0, always = 0;
    for (int round = 0; round < 300; ++round) {
        Arm arm;
        for (std::size_t i = 0; i < 2; ++i) {
            const double half = random.uniform(0, 1);
            const Vec3 at = test::random_direction(random) * (round % 2 ? 1.2 : 0.1);
            arm.movers.push_back({random.below(3) ? turns : slides, at, test::random_direction(random), -half, half});
        }
        const std::vector<Element> first = random_elements(random, 0.3), last = random_elements(random, 0.3);
        const Verdict said = verdict(arm, Elements(first), Elements(last), 500);
        const auto [apart, touching] = seen(arm, first, last, random);
        never += said == Verdict::never;
        always += said == Verdict::always;
        EXPECT_FALSE(said == Verdict::never && touching > 0) << round;
        EXPECT_FALSE(said == Verdict::always && apart > 0) << round;
    }
    EXPECT_GT(never, 30);
    EXPECT_GT(always, 10);
}

} // namespace
} // namespace foam::test
