// Growth by what files lose, and step by step until the proof holds.
#include "odd_elements.hpp"
#include "runtime/src/finish/finish.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

using Kind = Element::Kind;
using test::is_on;
using test::odd;

TEST(WrittenNumbers, SinglePrecisionTakesTwoOfItsUnits) {
    const double unit = std::numeric_limits<float>::epsilon();
    for (const Sphere& s : {Sphere{{4, 1, 2}, 3}, Sphere{{1, -4, 2}, 3}, Sphere{{1, 2, -4}, 3}, Sphere{{1, 2, 3}, 4},
                            Sphere{{-4, 1, 2}, 3}}) {
        EXPECT_EQ(float32_slack(s, Numbers::float32), 8 * unit);
        EXPECT_EQ(float32_slack(s, Numbers::float64), 0);
    }
}

TEST(WrittenNumbers, WithoutAGridElementsGrowByWhatFilesLose) {
    const DecimalGrid none(1e30);
    for (const Vec3& place : {Vec3{-3, 1, 2}, Vec3{3, -1.5, -2}, Vec3{0.5, 2, -4}}) {
        const auto solid = Solid::make(test::box(place - Vec3{0.1, 0.1, 0.1}, place + Vec3{0.1, 0.1, 0.1}));
        for (const Kind kind : {Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box}) {
            for (const bool turned : {false, true}) {
                Element e = odd(kind, 1);
                e.pose = turned ? Pose::from_axis_angle({0, 0, 1}, 0.3) : Pose{};
                e.pose.translation = place;
                const Box box = bounds(e);
                const auto far = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
                const double size =
                    norm({far(box.low.x, box.high.x), far(box.low.y, box.high.y), far(box.low.z, box.high.z)});
                const bool by_ends = kind == Kind::capsule || kind == Kind::cylinder;
                for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
                    Elements level(std::vector{e});
                    const double growth = finish_elements(*solid, level, none, true, numbers);
                    const double lost = numbers == Numbers::float32 ? size * 0x1p-20 : by_ends || turned ? size * 1e-12 : 0;
                    const Element& after = level[0];
                    EXPECT_NEAR(growth, lost, 1e-15) << to_string(kind);
                    EXPECT_NEAR(after.radius - e.radius, kind == Kind::box ? 0 : lost, 1e-15) << to_string(kind);
                    const bool longer = kind == Kind::box || kind == Kind::cylinder;
                    EXPECT_NEAR(after.half.z - e.half.z, longer ? lost : 0, 1e-15) << to_string(kind);
                }
            }
        }
    }
}

TEST(WrittenNumbers, ElementsGrowUntilTheyAreProvedBySteps) {
    const auto solid = Solid::make(test::box({-1, -0.1, -0.1}, {1, 0.1, 0.1}));
    const DecimalGrid grid(2), none(1e30);
    const double step = grid.step(), least = 1e-10 * solid->bounds().diagonal();
    // One step, two more, four more, ... : after n rounds 2^n - 1.
    for (const DecimalGrid& on : {grid, none}) {
        const double unit = on.step() > 0 ? step : least;
        for (const int missing : {-1, 0, 2, 6, 100, 4000, 4100}) {
            Element half{.kind = Kind::box, .half = {0.5, 0.2, 0.2}};
            half.pose.translation = {0.5, 0, 0};
            const Sphere ball{{-0.5, 0, 0}, std::sqrt(0.25 + 0.02) - missing * unit + unit / 2};
            half.half.x = 0.5 - missing * unit + unit / 2; // what overlaps covers, but for the ends
            const int rounds = missing <= 0 ? 0 : static_cast<int>(std::ceil(std::log2(missing + 0.5)));
            const double expected = missing > 4095 ? 4095 : std::ldexp(1, rounds) - 1;
            Elements level{{ball}, {half}};
            grow_until_proved(*solid, level, on);
            EXPECT_EQ(covers(*solid, level), missing < 4100) << missing;
            EXPECT_NEAR(level.spheres()[0].radius, ball.radius + expected * unit, 1.1 * rounds * on.step() + 1e-15) << missing;
            EXPECT_NEAR(level[1].half.x, half.half.x + expected * unit, 1.1 * rounds * on.step() + 1e-15) << missing;
            if (rounds > 0) {
                EXPECT_TRUE(is_on(on, level.spheres()[0].radius));
                EXPECT_TRUE(is_on(on, level[1].half.x));
            }
        }
    }
}

} // namespace
} // namespace foam
