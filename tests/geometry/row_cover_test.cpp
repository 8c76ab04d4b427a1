// Rows of balls around cylinders and capsules: they cover, the volume is right, no smaller row covers.
#include "geometry/shapes.hpp"

#include <foam/geometry/row_cover.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

namespace {

std::vector<Sphere> balls_of(const BallRow& row) {
    std::vector<Sphere> balls;
    for (std::size_t i = 0; i < row.count; ++i) {
        balls.push_back(
            {{0, 0, (2 * static_cast<double>(i) - static_cast<double>(row.count - 1)) * row.half_spacing}, row.radius});
    }
    return balls;
}

/// How far points of the primitive's outline are outside of the balls; negative: all are deeper than that.
double gap(const Element& primitive, const std::vector<Sphere>& balls) {
    const double half = primitive.half.z;
    double worst = -std::numeric_limits<double>::infinity();
    const auto look = [&](double across, double z) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& ball : balls) {
            nearest = std::min(nearest, distance({across, 0, z}, ball.center) - ball.radius);
        }
        worst = std::max(worst, nearest);
    };
    for (int i = 0; i <= 10'000; ++i) {
        const double t = i / 10'000.0;
        look(primitive.radius, (2 * t - 1) * half);
        if (primitive.kind == Element::Kind::capsule) {
            const double angle = t * std::numbers::pi / 2;
            look(primitive.radius * std::cos(angle), half + primitive.radius * std::sin(angle));
        } else {
            look(primitive.radius * t, half);
        }
    }
    return worst;
}

} // namespace

TEST(RowCover, HoldsJustWhatItMust) {
    for (const auto kind : {Element::Kind::cylinder, Element::Kind::capsule}) {
        for (const double length : {0.1, 1.0, 7.0}) {
            for (const std::size_t count : {1, 2, 3, 8, 30}) {
                const Element primitive = round_element(kind, 0.5, length);
                const BallRow row = kind == Element::Kind::capsule ? row_around_capsule(0.5, length, count)
                                                                     : row_around_cylinder(0.5, length, count);
                EXPECT_EQ(row.count, count);
                EXPECT_NEAR(gap(primitive, balls_of(row)), 0, 1e-6) << "length " << length << ", " << count;
                BallRow smaller = row;
                smaller.radius *= 1 - 1e-3;
                EXPECT_GT(gap(primitive, balls_of(smaller)), 1e-5);
                EXPECT_NEAR(row.volume() / union_volume(balls_of(row), 20'000), 1, 2e-3);
            }
        }
    }
    EXPECT_DOUBLE_EQ(row_around_capsule(0.5, 1, 1).radius, 1);
    EXPECT_DOUBLE_EQ(row_around_cylinder(3, 8, 1).radius, 5);
}

TEST(RowCover, IsProvedAsItIs) {
    Random random(5);
    for (const auto kind : {Element::Kind::cylinder, Element::Kind::capsule}) {
        for (const double length : {0.02, 0.3, 4.0}) {
            const auto solid = primitive_solid(round_element(kind, 0.1, length), random_pose(random, 2));
            double least = std::numeric_limits<double>::infinity();
            for (const std::size_t most : {1, 3, 12}) {
                const auto row = row_cover(*solid, most);
                ASSERT_TRUE(row);
                EXPECT_LE(row->size(), most);
                EXPECT_TRUE(certify(*solid, *row).holds);
                const double spacing = row->size() > 1 ? distance((*row)[0].center, (*row)[1].center) : 0;
                const double volume = BallRow{row->size(), row->front().radius, spacing / 2}.volume();
                EXPECT_LE(volume, least * (1 + 1e-9));
                least = volume;
            }
        }
    }
}

TEST(RowCover, NothingForOtherSolids) {
    EXPECT_FALSE(row_cover(*Solid::make(box({0, 0, 0}, {1, 1, 1})), 4));
    EXPECT_FALSE(row_cover(*primitive_solid(Element::box({1, 2, 3})), 4));
    EXPECT_FALSE(row_cover(*primitive_solid(Element::sphere(1)), 4));
}
