// The text of a plot: well-formed, the same every time, and with what was handed in.
#include <foam/report/internal/plot.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stack>

namespace foam::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Plot small_plot() {
    Plot plot;
    plot.title = "Time <of> \"all\" & more";
    plot.x = {"triangles", true, {}};
    plot.y = {"s", true, {}};
    plot.panels = {{"one", {{"a & b", {{1, 1}, {10, 5}, {100, 40}}, false}, {"old", {{1, 100}, {100, 300}}, true}}},
                   {"two", {{"a & b", {{2, 3}, {0, 7}, {20, -1}, {50, 9}}, false}}}};
    return plot;
}

/// Elements are closed in the order in which they were opened, attributes have quotes, no other '<' or '&' is left.
void expect_well_formed(const std::string& xml) {
    std::stack<std::string> open;
    std::size_t at = xml.find("?>");
    ASSERT_NE(at, xml.npos);
    at += 2;
    while ((at = xml.find_first_of("<&", at)) != xml.npos) {
        if (xml[at] == '&') {
            EXPECT_THAT(xml.substr(at, 6), ::testing::MatchesRegex("&(amp;|lt;|gt;|quot;).*"));
            ++at;
            continue;
        }
        const std::size_t end = xml.find('>', at);
        ASSERT_NE(end, xml.npos);
        const std::string tag = xml.substr(at + 1, end - at - 1);
        EXPECT_EQ(tag.find('<'), tag.npos) << tag;
        EXPECT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
        const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" />", 1) - (tag[0] == '/'));
        if (tag[0] == '/') {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(open.top(), name);
            open.pop();
        } else if (tag.back() != '/') {
            open.push(name);
        }
        at = end;
    }
    EXPECT_TRUE(open.empty());
}

TEST(Svg, IsWellFormedAndTheSameEveryTime) {
    const std::string svg = to_svg(small_plot());
    expect_well_formed(svg);
    EXPECT_EQ(svg, to_svg(small_plot()));
    expect_well_formed(to_svg(Plot{}));
}

TEST(Svg, HoldsTitlesLabelsAndBothSchemes) {
    const std::string svg = to_svg(small_plot());
    for (const char* part : {"Time &lt;of&gt; &quot;all&quot; &amp; more", ">a &amp; b</text>", ">one</text>",
                             ">two</text>", ">triangles</text>", "prefers-color-scheme: dark"}) {
        EXPECT_THAT(svg, HasSubstr(part));
    }
    EXPECT_THAT(svg, Not(HasSubstr("href")));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(Svg, LeavesOutWhatALogarithmDoesNotHave) {
    const std::string svg = to_svg(small_plot());
    std::size_t circles = 0;
    for (std::size_t at = 0; (at = svg.find("<circle", at)) != svg.npos; ++at) {
        ++circles;
    }
    EXPECT_EQ(circles, 3U + 2U + 1U); // panel one, panel two, the legend
}

} // namespace
} // namespace foam::plot
