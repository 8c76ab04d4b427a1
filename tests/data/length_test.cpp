// Lengths with units, read and told.
#include <foam/base/error.hpp>
#include <foam/geometry/length.hpp>
#include <foam/recipe/mesh_unit.hpp>

#include <gtest/gtest.h>

namespace foam::test {
namespace {

TEST(Length, IsReadInMetres) {
    EXPECT_EQ(parse_length("10mm"), 0.01);
    EXPECT_EQ(parse_length("7mm"), 0.007) << "the nearest double, not 7 times that of 0.001";
    EXPECT_EQ(parse_length("-2.5 cm"), -0.025);
    EXPECT_EQ(parse_length("1e3mm"), 1);
    EXPECT_EQ(parse_length("0.4in"), 0.4 * 0.0254);
    EXPECT_EQ(parse_length("0.25m"), 0.25);
    EXPECT_EQ(parse_length(".5"), 0.5);
    EXPECT_EQ(parse_length("12"), 12);
}

TEST(Length, IsNothingElse) {
    for (const char* text : {"", "mm", " ", "10km", "10MM", "10 ft", "10  mm", "10mm ", "1,5mm", "10mmm", "mm10",
                             "1e999", "1e309mm", "nan", "inf", "infm", "10 "}) {
        EXPECT_EQ(parse_length(text), std::nullopt) << text;
    }
}

TEST(Length, IsToldToThreeDigits) {
    EXPECT_EQ(length_text(0.12), "120 mm");
    EXPECT_EQ(length_text(0.0004), "0.4 mm");
    EXPECT_EQ(length_text(1.23456), "1.23 m");
    EXPECT_EQ(length_text(1234567), "1,234,567 m");
    Box box;
    box.add(Vec3{-0.04, 0, 0});
    box.add(Vec3{0.04, 0.08, 0.12});
    EXPECT_EQ(size_text(box), "80 x 80 x 120 mm");
    box.add(Vec3{0, 0, 1.5});
    EXPECT_EQ(size_text(box), "0.08 x 0.08 x 1.5 m");
    EXPECT_EQ(count_text(999), "999");
    EXPECT_EQ(count_text(5120), "5,120");
    EXPECT_EQ(count_text(1000000), "1,000,000");
}

TEST(MeshUnit, GivesAFactor) {
    EXPECT_EQ((MeshUnit{"mm", 1}.factor()), 0.001);
    EXPECT_EQ((MeshUnit{"in", 10}.factor()), 0.254);
    EXPECT_EQ(MeshUnit{}.factor(), 1);
    EXPECT_THROW((MeshUnit{"km", 1}.factor()), Error);
    for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW((MeshUnit{"m", scale}.factor()), Error) << scale;
    }
}

} // namespace
} // namespace foam::test
