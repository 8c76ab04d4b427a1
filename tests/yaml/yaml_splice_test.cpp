// Values are replaced, all other bytes stay.
#include <foam/yaml/write.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace foam;
using testing::HasSubstr;

std::string spliced(const std::string& text, const std::vector<std::string_view>& path, const yaml::Value& value) {
    yaml::Splice splice(text, "robot.yml", ErrorCode::input);
    splice.set(path, value);
    return splice.text();
}

const yaml::Value links = yaml::map({{"a", yaml::list({yaml::map({{"radius", yaml::real(1)}})})}});

TEST(YamlSplice, ABlockIsReplacedByABlock) {
    EXPECT_EQ(spliced("# top\nx:\n  s:   # spheres\n    b:\n      - 1\n\n    # within\n    c: 2\n  # after\n  t: 3\n",
                      {"x", "s"}, links),
              "# top\nx:\n  s:   # spheres\n    a:\n      - {radius: 1.0}\n  # after\n  t: 3\n");
    EXPECT_EQ(spliced("s:\n- b: 1\n- c: 2\nt: 3\n", {"s"}, links), "s:\n  a:\n    - {radius: 1.0}\nt: 3\n");
    EXPECT_EQ(spliced("s:\n  - 1\n", {"s"}, yaml::list()), "s: []\n");
    EXPECT_EQ(spliced("x:\n    s:\n        b: 1", {"x", "s"}, links),
              "x:\n    s:\n      a:\n        - {radius: 1.0}\n");
}

TEST(YamlSplice, AValueOnOneLineStaysOnIt) {
    EXPECT_EQ(spliced("s: {b: [1, 2]}   # c\nt: 1\n", {"s"}, links), "s: {a: [{radius: 1.0}]}   # c\nt: 1\n");
    EXPECT_EQ(spliced("s: 'a.yml' # c\n", {"s"}, links), "s: {a: [{radius: 1.0}]} # c\n");
    EXPECT_EQ(spliced("s: null\nt: 1\n", {"s"}, links), "s: {a: [{radius: 1.0}]}\nt: 1\n");
    EXPECT_EQ(spliced("x: {s: 1, t: {s: 2}}\n", {"x", "t", "s"}, yaml::list()), "x: {s: 1, t: {s: []}}\n");
    EXPECT_EQ(spliced("x: {s: \"a, } b\", t: 1}\n", {"x", "s"}, yaml::list()), "x: {s: [], t: 1}\n");
    EXPECT_EQ(spliced("s: {b: [1, # ]\n  2]\n}\nt: 1\n", {"s"}, yaml::list()), "s: []\nt: 1\n");
    EXPECT_EQ(spliced("é: {s: 1}\n", {"é", "s"}, yaml::list()), "é: {s: []}\n");
}

TEST(YamlSplice, AMissingKeyIsAddedAtTheEndOfItsMap) {
    EXPECT_EQ(spliced("x:\n  a: 1\n  b:\n    c: 2\ny: 3\n", {"x", "s"}, links),
              "x:\n  a: 1\n  b:\n    c: 2\n  s:\n    a:\n      - {radius: 1.0}\ny: 3\n");
    EXPECT_EQ(spliced("x: 1", {"s"}, links), "x: 1\ns:\n  a:\n    - {radius: 1.0}\n");
}

TEST(YamlSplice, AMissingKeyIsAddedWithinBrackets) {
    EXPECT_EQ(spliced("x: {t: 1}   # c\n", {"x", "s"}, yaml::list()), "x: {t: 1, s: []}   # c\n");
    EXPECT_EQ(spliced("x: {}\n", {"x", "s"}, yaml::list()), "x: {s: []}\n");
}

std::string extended(const std::string& text, const std::vector<std::string_view>& path, const yaml::Value& items) {
    yaml::Splice splice(text, "robot.yml", ErrorCode::input);
    splice.extend(path, items);
    return splice.text();
}

TEST(YamlSplice, AListIsExtendedAndKeepsItsBytes) {
    const yaml::Value more = yaml::list(std::vector<std::string>{"p", "q_r"});
    EXPECT_EQ(extended("s: [a,  b]  # c\n", {"s"}, more), "s: [a,  b, p, q_r]  # c\n");
    EXPECT_EQ(extended("s: [a, b,]\n", {"s"}, more), "s: [a, b, p, q_r]\n");
    EXPECT_EQ(extended("s: [\n  a,\n  'b, c', # one, two\n]\n", {"s"}, more),
              "s: [\n  a,\n  'b, c', p, q_r # one, two\n]\n");
    EXPECT_EQ(extended("s: [\n  a # it's, one\n]\n", {"s"}, more), "s: [\n  a, p, q_r # it's, one\n]\n");
    EXPECT_EQ(extended("s: []\n", {"s"}, more), "s: [p, q_r]\n");
    EXPECT_EQ(extended("x:\n  s:   # mine\n  - a\n  # between\n  - b   # last\n  t: 1\n", {"x", "s"}, more),
              "x:\n  s:   # mine\n  - a\n  # between\n  - b   # last\n  - p\n  - q_r\n  t: 1\n");
    EXPECT_EQ(extended("s:\n    - a", {"s"}, more), "s:\n    - a\n    - p\n    - q_r");
    EXPECT_EQ(extended("s: null\n", {"s"}, more), "s: [p, q_r]\n");
    EXPECT_EQ(extended("t: 1\n", {"s"}, more), "t: 1\ns: [p, q_r]\n");
    EXPECT_THROW(extended("s: 1\n", {"s"}, more), Error);
}

TEST(YamlSplice, WhatCannotBeReplacedIsRefusedWithItsPlace) {
    const auto refusal = [](const std::string& text, const std::vector<std::string_view>& path) -> std::string {
        try {
            return spliced(text, path, links);
        } catch (const Error& error) {
            return error.what();
        }
    };
    EXPECT_THAT(refusal("x:\n  s:\nt: 1\n", {"x", "s"}), HasSubstr("robot.yml:2:3: 's' has no value; remedy: "));
    EXPECT_THAT(refusal("x: 1\n", {"x", "s"}), HasSubstr("there is no map 'x'"));
    EXPECT_THAT(refusal("- 1\n", {"s"}), HasSubstr("robot.yml:1:1: a map of keys is expected, got a list"));
    EXPECT_THAT(refusal("x: [1\n", {"s"}), HasSubstr("robot.yml:"));
    EXPECT_THAT(refusal("", {"s"}), HasSubstr("robot.yml"));
}

} // namespace
