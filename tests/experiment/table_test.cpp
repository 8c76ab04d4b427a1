// CSV there and back, Markdown.
#include "bench/src/table.hpp"

#include <foam/base/error.hpp>

#include <gtest/gtest.h>

namespace foam::experiment {
namespace {

const Table table{{"a", "b, c"}, {{"1", ""}, {"say \"so\"", "x\ny"}, {"|", "3"}}};

TEST(Table, CsvThereAndBack) {
    const std::string csv = to_csv(table);
    EXPECT_EQ(csv, "a,\"b, c\"\n1,\n\"say \"\"so\"\"\",\"x\ny\"\n|,3\n");
    const Table again = parse_csv(csv, "t.csv");
    EXPECT_EQ(again.columns, table.columns);
    EXPECT_EQ(again.rows, table.rows);
}

TEST(Table, CsvOfOthers) {
    const Table read = parse_csv("x,y\r\n1,\"[1, 8]\"\r\n2,", "t.csv");
    EXPECT_EQ(read.rows, (std::vector<std::vector<std::string>>{{"1", "[1, 8]"}, {"2", ""}}));
}

std::string message(const char* csv) {
    try {
        parse_csv(csv, "t.csv");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Table, DamagedCsv) {
    EXPECT_EQ(message("a,b\n1,2,3\n"), "t.csv: line 2 has 3 cells, the first 2");
    EXPECT_EQ(message("a,b\n1,\"2\n"), "t.csv:2: a quote does not end");
}

TEST(Table, Markdown) {
    EXPECT_EQ(to_markdown({{"a", "b"}, {{"x|y", "1"}}}), "| a | b |\n|---|---:|\n| x\\|y | 1 |\n");
}

} // namespace
} // namespace foam::experiment
