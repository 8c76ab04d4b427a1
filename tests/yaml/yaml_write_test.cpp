// YAML and JSON text from values.
#include <foam/base/text.hpp>
#include <foam/yaml/write.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace foam;

yaml::Value read(const std::string& text) {
    yaml::Findings findings("text");
    const auto root = yaml::read_yaml(text, 0, findings);
    EXPECT_FALSE(findings.any_error()) << text;
    return root.value_or(yaml::Value());
}

TEST(YamlWrite, NumbersHaveAPointAndASignedExponent) {
    EXPECT_EQ(yaml::real_text(0), "0.0");
    EXPECT_EQ(yaml::real_text(2), "2.0");
    EXPECT_EQ(yaml::real_text(-0.1), "-0.1");
    EXPECT_EQ(yaml::real_text(1e-5), "1.0e-05");
    EXPECT_EQ(yaml::real_text(5.25e-5), "5.25e-05");
    EXPECT_EQ(yaml::real_text(1e22), "1.0e+22");
    for (const double value : {0.1, 1.0 / 3, 1e-300, 5e-324, -2.5e17, std::numeric_limits<double>::max()}) {
        EXPECT_EQ(parse_number(yaml::real_text(value)), value);
        EXPECT_EQ(read(yaml::real_text(value)).real, value);
    }
}

TEST(YamlWrite, WordsThatAReaderTakesForAnotherTypeAreQuoted) {
    for (const char* plain : {"panda_link0", "l", "tool0", "robot/ur10e.urdf", "a.b-c"}) {
        EXPECT_EQ(yaml::scalar_text(plain), plain);
    }
    for (const char* other : {"on", "Yes", "NO",   "null", "~",      "1",   "1e3", "1.0", "a: b", "#x",  "",
                              " a", "-",   "0x1F", "y",    "link 1", "a,b", "[",   "nan", "true", "a#b", "1_000"}) {
        EXPECT_EQ(yaml::scalar_text(other).front(), '"') << other;
        EXPECT_EQ(read(yaml::scalar_text(other)).text, other);
        EXPECT_TRUE(read(yaml::scalar_text(other)).is(yaml::Value::Kind::text)) << other;
    }
    EXPECT_EQ(yaml::scalar_text("a\"b\\\n"), "\"a\\\"b\\\\\\x0a\"");
}

TEST(YamlWrite, ShortCollectionsAreOnOneLine) {
    const yaml::Value sphere = yaml::map({{"center", yaml::list({0.5, 1.0, 2.0})}, {"radius", yaml::real(3)}});
    const yaml::Value tree =
        yaml::map({{"links", yaml::map({{"a", yaml::list({sphere, sphere})}, {"on", yaml::list()}})},
                   {"pairs", yaml::list({yaml::map({{"b", yaml::list({sphere})}})})},
                   {"empty", yaml::map()}});
    EXPECT_EQ(yaml::block_text(tree), "links:\n"
                                      "  a:\n"
                                      "    - {center: [0.5, 1.0, 2.0], radius: 3.0}\n"
                                      "    - {center: [0.5, 1.0, 2.0], radius: 3.0}\n"
                                      "  \"on\": []\n"
                                      "pairs:\n"
                                      "  - b:\n"
                                      "      - {center: [0.5, 1.0, 2.0], radius: 3.0}\n"
                                      "empty: {}\n");
    EXPECT_EQ(yaml::flow_text(tree.items[0]),
              "{a: [{center: [0.5, 1.0, 2.0], radius: 3.0}, {center: [0.5, 1.0, 2.0], radius: 3.0}], \"on\": []}");
}

TEST(YamlWrite, JsonIsYaml) {
    const yaml::Value tree = yaml::map({{"a\n", yaml::list({yaml::list({1.0, 2.0}), yaml::list({3.0, 4.0})})},
                                        {"b", yaml::map({{"c", yaml::text("\"")}, {"d", yaml::boolean(true)}})}});
    EXPECT_EQ(yaml::json_text(tree), "{\n"
                                     "  \"a\\u000a\": [\n"
                                     "    [1.0, 2.0],\n"
                                     "    [3.0, 4.0]\n"
                                     "  ],\n"
                                     "  \"b\": {\"c\": \"\\\"\", \"d\": true}\n"
                                     "}\n");
}

} // namespace
