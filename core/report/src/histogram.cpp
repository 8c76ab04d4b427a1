// The histogram of radii.
#include "scale.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace foam::inline report {
namespace {

/// Sizes in pixels.
constexpr double left = 56, top = 12, plot_width = 620, plot_height = 180, below = 46, right = 14;
constexpr std::size_t bins_per_tick = 5;

struct Histogram {
    plot::Scale x, y;
    std::vector<std::size_t> counts;
};

Histogram histogram_of(const std::vector<double>& radii) {
    Histogram result;
    result.x = plot::scale_over(radii);
    result.counts.resize(bins_per_tick * std::max<std::size_t>(1, result.x.ticks.size() - 1));
    for (const double radius : radii) {
        const double place = result.x.position(radius) * static_cast<double>(result.counts.size());
        ++result.counts[std::min(static_cast<std::size_t>(place), result.counts.size() - 1)];
    }
    result.y = plot::scale_over({static_cast<double>(*std::max_element(result.counts.begin(), result.counts.end()))});
    return result;
}

class Drawing {
public:
    explicit Drawing(const Histogram& histogram) : histogram_(histogram) {}

    std::string svg() {
        const double width = left + plot_width + right, height = top + plot_height + below;
        add("<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Histogram of the radii\">\n",
            width, height);
        for (const plot::Tick& tick : histogram_.y.ticks) {
            if (tick.value == static_cast<double>(static_cast<std::size_t>(tick.value))) { // counts are integers
                const double y = down(tick.value);
                add("<path class=\"grid\" d=\"M{:.1f} {:.1f}h{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
                    "text-anchor=\"end\">{}</text>\n",
                    left, y, plot_width, left - 8, y + 4, tick.label);
            }
        }
        add_bars();
        for (const plot::Tick& tick : histogram_.x.ticks) {
            const double x = left + plot_width * histogram_.x.position(tick.value);
            add("<path class=\"axis\" d=\"M{:.1f} {:.1f}v5\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
                "text-anchor=\"middle\">{}</text>\n",
                x, top + plot_height, x, top + plot_height + 20, tick.label);
        }
        add("<path class=\"axis\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", left, top + plot_height, plot_width);
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">radius, mm</text>\n", left + plot_width / 2,
            height - 6);
        add("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">spheres</text>\n</svg>\n",
            top + plot_height / 2);
        return std::move(text_);
    }

private:
    template <class... T> void add(fmt::format_string<T...> format, T&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
    }
    double down(double count) const { return top + plot_height * (1 - histogram_.y.position(count)); }

    void add_bars() {
        const auto bins = static_cast<double>(histogram_.counts.size());
        const double width = plot_width / bins, radius = (histogram_.x.high - histogram_.x.low) / bins;
        for (std::size_t i = 0; i < histogram_.counts.size(); ++i) {
            if (histogram_.counts[i] > 0) {
                const auto at = static_cast<double>(i);
                const double y = down(static_cast<double>(histogram_.counts[i]));
                add("<rect class=\"column\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
                    "<title>{} to {} mm: {}</title></rect>\n",
                    left + at * width + 0.5, y, width - 1, top + plot_height - y,
                    plot::tick_label(histogram_.x.low + at * radius),
                    plot::tick_label(histogram_.x.low + (at + 1) * radius), counted(histogram_.counts[i], "sphere"));
            }
        }
    }

    const Histogram& histogram_;
    std::string text_;
};

} // namespace

std::string radii_section(const Report& report) {
    std::vector<double> radii;
    for (const ReportLink& link : report.links) {
        for (const Sphere& sphere : link.scene.levels.back().spheres()) {
            radii.push_back(mm_per_m * sphere.radius);
        }
    }
    if (radii.empty()) {
        return {};
    }
    const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
    return section("radii", "Radii",
                   Drawing(histogram_of(radii)).svg() + fmt::format("<p class=\"note\">{}, from {} to {} mm.</p>\n",
                                                                    counted(radii.size(), "sphere"), number(*least, 2),
                                                                    number(*most, 2)));
}

} // namespace foam::inline report
