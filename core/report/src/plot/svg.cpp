#include "scale.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace foam::inline report::plot {
namespace {

/// Pixels. Letters are taken to be 0.58 of their height wide on average, as sans serif ones are.
constexpr double letter = 13, letter_width = 0.58 * letter;
constexpr double margin = 18, title_height = 34, panel_title_height = 22, below = 48, left = 82, between = 22;
constexpr double legend_line = 22, legend_symbol = 34;
constexpr double tick = 5, marker = 4;

/// Okabe and Ito, 2008, darkened for thin lines on white; the second list is the same hues on black.
constexpr std::array<const char*, 8> light{"#0072b2", "#c04a00", "#008060", "#b0508a",
                                           "#806000", "#30363d", "#5b3fa0", "#a01030"};
constexpr std::array<const char*, 8> dark{"#58a6ff", "#ff9350", "#3fd0a0", "#f29ac6",
                                          "#e0c84a", "#f0f6fc", "#b99cff", "#ff7b7b"};
constexpr std::size_t marker_kinds = 5;

std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// The labels of all panels in the order of their first series, and which of them are of other programs.
struct Legend {
    std::vector<std::string> labels;
    std::vector<bool> reference;

    explicit Legend(const Plot& plot) {
        for (const Panel& panel : plot.panels) {
            for (const Series& series : panel.series) {
                if (std::find(labels.begin(), labels.end(), series.label) == labels.end()) {
                    labels.push_back(series.label);
                    reference.push_back(series.reference);
                }
            }
        }
    }
    std::size_t index(const std::string& label) const {
        return static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    }
    double width() const {
        std::size_t longest = 0;
        for (const std::string& label : labels) {
            longest = std::max(longest, letters(label));
        }
        return legend_symbol + letter_width * static_cast<double>(longest);
    }
};

class Drawing {
public:
    explicit Drawing(const Plot& plot) : plot_(plot), legend_(plot) {
        std::vector<double> x, y;
        for (const Panel& panel : plot.panels) {
            for (const Series& series : panel.series) {
                for (const auto& point : series.points) {
                    x.push_back(point.first);
                    y.push_back(point.second);
                }
            }
        }
        x_ = scale_over(plot.x, x);
        y_ = scale_over(plot.y, y);
        const bool single = plot.panels.size() == 1;
        panel_width_ = single ? 500 : 250;
        panel_height_ = single ? 360 : 280;
        const bool titled = std::any_of(plot.panels.begin(), plot.panels.end(),
                                        [](const Panel& panel) { return !panel.title.empty(); });
        top_ = margin + title_height + (titled ? panel_title_height : 0);
    }

    std::string text() {
        const auto panels = static_cast<double>(plot_.panels.size());
        const double legend_x = left + panels * panel_width_ + (panels - 1) * between + margin;
        const double width = legend_x + legend_.width() + margin;
        const double lines = legend_line * static_cast<double>(legend_.labels.size());
        const double height = top_ + std::max(panel_height_ + below, lines + margin);
        add(R"(<?xml version="1.0" encoding="UTF-8"?>)"
            "\n"
            R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}" role="img" aria-label="{2}">)"
            "\n<title>{2}</title>\n",
            width, height, markup_escaped(plot_.title));
        add_style();
        add("<rect class=\"paper\" width=\"{:.0f}\" height=\"{:.0f}\"/>\n", width, height);
        add("<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", margin, margin + letter,
            markup_escaped(plot_.title));
        for (std::size_t p = 0; p < plot_.panels.size(); ++p) {
            add_panel(plot_.panels[p], left + static_cast<double>(p) * (panel_width_ + between), p == 0);
        }
        const double middle = top_ + panel_height_ / 2;
        add("<text class=\"label\" text-anchor=\"middle\" transform=\"translate({:.1f} {:.1f}) "
            "rotate(-90)\">{}</text>\n",
            margin, middle, markup_escaped(plot_.y.label));
        add("<text class=\"label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
            (left + legend_x - margin) / 2, top_ + panel_height_ + below - margin / 2, markup_escaped(plot_.x.label));
        add_legend(legend_x);
        return std::move(text_) + "</svg>\n";
    }

private:
    template <class... T> void add(fmt::format_string<T...> format, T&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
    }

    void add_colours(const char* paper, const char* ink, const char* grid, const char* grey,
                     const std::array<const char*, 8>& colours) {
        add(".paper{{fill:{0}}} .title,.label{{fill:{1}}} .axis{{stroke:{1}}} .grid{{stroke:{2}}}\n"
            ".line.reference{{stroke:{3}}} .mark.reference{{fill:{0};stroke:{3}}}\n",
            paper, ink, grid, grey);
        for (std::size_t i = 0; i < std::min(colours.size(), legend_.labels.size()); ++i) {
            add(".line.c{0}{{stroke:{1}}} .mark.c{0}{{fill:{1};stroke:{2}}}\n", i, colours[i], paper);
        }
    }

    void add_style() {
        add("<style>\ntext{{font:{:.0f}px sans-serif}} .title{{font-size:15px;font-weight:bold}}\n"
            ".line{{fill:none;stroke-width:2;stroke-linejoin:round}} .line.reference{{stroke-dasharray:6 4}}\n"
            ".line.again{{stroke-dasharray:2 3}} .axis{{fill:none}} .grid{{stroke-width:1}}\n",
            letter);
        add_colours("#ffffff", "#1f2328", "#e1e5ea", "#6e7781", light);
        add("@media (prefers-color-scheme: dark){{\n");
        add_colours("#0d1117", "#e6edf3", "#2b323b", "#9aa4af", dark);
        add("}}\n</style>\n");
    }

    double across(double x0, double value) const { return x0 + panel_width_ * x_.position(value); }
    double down(double value) const { return top_ + panel_height_ * (1 - y_.position(value)); }

    void add_axes(double x0, bool first) {
        const double bottom = top_ + panel_height_;
        for (const Tick& t : x_.ticks) {
            const double x = across(x0, t.value);
            if (t.label.empty()) {
                add("<path class=\"axis\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>\n", x, bottom, tick / 2);
                continue;
            }
            add("<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/><path class=\"axis\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>",
                x, top_, bottom, x, bottom, tick);
            add("<text class=\"label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x,
                bottom + tick + letter, t.label);
        }
        for (const Tick& t : y_.ticks) {
            const double y = down(t.value);
            if (t.label.empty()) {
                add("<path class=\"axis\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", x0, y, -tick / 2);
                continue;
            }
            add("<path class=\"grid\" d=\"M{:.1f} {:.1f}h{:.1f}\"/><path class=\"axis\" d=\"M{:.1f} "
                "{:.1f}h{:.1f}\"/>\n",
                x0, y, panel_width_, x0, y, -tick);
            if (first) {
                add("<text class=\"label\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x0 - tick - 3,
                    y + 0.35 * letter, t.label);
            }
        }
        add("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}h{:.1f}\"/>\n", x0, top_, bottom, panel_width_);
    }

    void add_panel(const Panel& panel, double x0, bool first) {
        if (!panel.title.empty()) {
            add("<text class=\"title\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                x0 + panel_width_ / 2, top_ - 8, markup_escaped(panel.title));
        }
        add_axes(x0, first);
        for (const Series& series : panel.series) {
            std::string path;
            std::vector<std::pair<double, double>> spots;
            for (const auto& [x, y] : series.points) {
                if (x_.holds(x) && y_.holds(y)) {
                    spots.emplace_back(across(x0, x), down(y));
                    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? "M" : "L",
                                   spots.back().first, spots.back().second);
                }
            }
            const std::size_t index = legend_.index(series.label);
            if (spots.size() > 1) {
                add("<path class=\"line {}\" d=\"{}\"/>\n", look(index), path);
            }
            for (const auto& [x, y] : spots) {
                add_marker(index, x, y);
            }
        }
    }

    std::string look(std::size_t index) const {
        return legend_.reference[index]
                   ? "reference"
                   : fmt::format("c{}{}", index % light.size(), index < light.size() ? "" : " again");
    }

    void add_marker(std::size_t index, double x, double y) {
        const std::string style = fmt::format("mark {}", look(index));
        switch (index % marker_kinds) {
        case 0:
            add("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", style, x, y, marker);
            break;
        case 1:
            add("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", style,
                x - 0.9 * marker, y - 0.9 * marker, 1.8 * marker, 1.8 * marker);
            break;
        case 2:
            add_polygon(style, x, y, {{0, -1.3}, {1.15, 0.8}, {-1.15, 0.8}});
            break;
        case 3:
            add_polygon(style, x, y, {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}});
            break;
        default:
            add_polygon(style, x, y, {{0, 1.3}, {1.15, -0.8}, {-1.15, -0.8}});
        }
    }

    void add_polygon(const std::string& style, double x, double y,
                     std::initializer_list<std::pair<double, double>> corners) {
        std::string points;
        for (const auto& [dx, dy] : corners) {
            points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", x + marker * dx, y + marker * dy);
        }
        add("<polygon class=\"{}\" points=\"{}\"/>\n", style, points);
    }

    void add_legend(double x0) {
        for (std::size_t i = 0; i < legend_.labels.size(); ++i) {
            const double y = top_ + legend_line * (static_cast<double>(i) + 0.5);
            add("<path class=\"line {}\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", look(i), x0, y, legend_symbol - 8);
            add_marker(i, x0 + (legend_symbol - 8) / 2, y);
            add("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x0 + legend_symbol, y + 0.35 * letter,
                markup_escaped(legend_.labels[i]));
        }
    }

    const Plot& plot_;
    Legend legend_;
    Scale x_, y_;
    double panel_width_ = 0, panel_height_ = 0, top_ = 0;
    std::string text_;
};

} // namespace

std::string to_svg(const Plot& plot) {
    return Drawing(plot).text();
}

} // namespace foam::report::plot
