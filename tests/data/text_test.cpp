// Numbers and words.
#include <foam/base/random.hpp>
#include <foam/base/text.hpp>

#include <gmock/gmock.h>

#include <bit>
#include <clocale>
#include <cmath>

namespace foam {
namespace {

TEST(Text, NumbersComeBackExactly) {
    Random random(1);
    for (int i = 0; i < 20'000; ++i) {
        const double value = std::bit_cast<double>(random.bits());
        if (std::isfinite(value)) {
            const std::optional<double> back = parse_number(number_text(value));
            ASSERT_TRUE(back) << number_text(value);
            EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
        }
    }
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(-0.0), "-0");
}

TEST(Text, ANounHasItsArticle) {
    EXPECT_EQ(with_article("swept box"), "a swept box");
    EXPECT_EQ(with_article("ellipsoid"), "an ellipsoid");
}

TEST(Text, OnlyWholeFiniteNumbersAreRead) {
    EXPECT_EQ(parse_number("+1.5e1"), 15);
    EXPECT_EQ(parse_number("-.5"), -0.5);
    EXPECT_EQ(parse_number("5."), 5);
    for (const char* text :
         {"", "+", "-", "+-1", "++1", " 1", "1 ", "1,5", "0x10", "nan", "inf", "-infinity", "1e999", "1f", "."}) {
        EXPECT_FALSE(parse_number(text)) << "'" << text << "'";
    }
}

TEST(Text, TheLocaleDoesNotMatter) {
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
    }
    EXPECT_EQ(number_text(0.5), "0.5");
    EXPECT_EQ(parse_number("0.5"), 0.5);
    std::setlocale(LC_ALL, "C");
}

TEST(Text, Words) {
    EXPECT_THAT(words("  a\tbc\r\nd "), testing::ElementsAre("a", "bc", "d"));
    EXPECT_THAT(words(" \n"), testing::IsEmpty());
}

TEST(Text, PercentEscapes) {
    EXPECT_EQ(percent_decoded("my%20part%2fB%2F"), "my part/B/");
    EXPECT_EQ(percent_decoded("%25%41%7e%Ff"), "%A~\xff");
    EXPECT_EQ(percent_decoded("%2541"), "%41") << "once";
    for (const char* text : {"", "50%", "%4", "%%", "%4g", "%g4", "%1z", "% 1", "%+1", "%00"}) {
        EXPECT_EQ(percent_decoded(text), text);
    }
}

TEST(Text, WhatIsShownSteersNoTerminal) {
    EXPECT_EQ(shown("base_link, größe 漢字"), "base_link, größe 漢字");
    EXPECT_EQ(shown("a\x1b[31m\n\t\x7f" + std::string(1, '\0')), "a\\x1b[31m\\x0a\\x09\\x7f\\x00");
    EXPECT_EQ(shown("\u009b\u202e\u2066\u200e\u061c\u2028"), "\\u{009b}\\u{202e}\\u{2066}\\u{200e}\\u{061c}\\u{2028}");
    EXPECT_EQ(shown("\xff\xc0\xaf\xed\xa0\x80\xc3"), "\\xff\\xc0\\xaf\\xed\\xa0\\x80\\xc3");
    EXPECT_EQ(shown_lines("a\nb\r"), "a\nb\\x0d");
}

TEST(Text, WidthsAreColumns) {
    EXPECT_EQ(shown_width("größe"), 5u);
    EXPECT_EQ(shown_width("漢字"), 4u);
    EXPECT_EQ(shown_width("e\u0301"), 1u);
}

TEST(Text, Base64OfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xFF\x00\xFE", 3)), "/wD+");
}

} // namespace
} // namespace foam
