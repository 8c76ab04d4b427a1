#include "colour_bar.hpp"

#include "scale.hpp"
#include "scene.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace foam::snapshot {
namespace {

void put_ruled_bar(cv::Mat3b& picture, const Rectangle& bar) {
    const int left = static_cast<int>(std::lround(bar.left)), top = static_cast<int>(std::lround(bar.top));
    const int width = static_cast<int>(std::lround(bar.width)), height = static_cast<int>(std::lround(bar.height));
    for (int y = std::max(0, top); y < std::min(picture.rows, top + height); ++y) {
        const Colour c = colour_of(top + height - 1 - y, 0, height - 1);
        for (int x = std::max(0, left); x < std::min(picture.cols, left + width); ++x) {
            picture(y, x) = {c[2], c[1], c[0]};
        }
    }
    cv::rectangle(picture, {left, top, width, height}, {90, 80, 75}, 1);
}

} // namespace

void draw_colour_bar(cv::Mat3b& picture, const Layout& layout, Lettering& lettering) {
    const Rectangle& bar = *layout.colour_bar;
    const Scale scale = make_scale(layout.radii.least, layout.radii.most);
    const cv::Vec3b ink{50, 40, 35};
    const double size = 17 * layout.unit;
    put_ruled_bar(picture, bar);
    const double range = layout.radii.most - layout.radii.least;
    for (const Tick& tick : scale.ticks) {
        const double share = scale.ticks.size() == 1 ? 0.5 : (tick.value - layout.radii.least) / range;
        const double y = bar.top + (1 - share) * (bar.height - 1);
        const double right = bar.left + bar.width;
        cv::line(picture, {static_cast<int>(std::lround(right)), static_cast<int>(std::lround(y))},
                 {static_cast<int>(std::lround(right + 5 * layout.unit)), static_cast<int>(std::lround(y))},
                 {90, 80, 75}, 1);
        lettering.draw(picture, tick.label, right + 10 * layout.unit, y + 0.36 * size, size, ink);
    }
    const std::string label = "radius [" + scale.unit + "]";
    lettering.draw(picture, label, bar.left, bar.top - 14 * layout.unit, size, ink);
}

const std::array<Colour, 256>& viridis() {
    static const std::array<Colour, 256> table = [] {
        cv::Mat1b ramp(1, 256);
        for (int i = 0; i < 256; ++i) {
            ramp(0, i) = static_cast<unsigned char>(i);
        }
        cv::Mat3b colours;
        cv::applyColorMap(ramp, colours, cv::COLORMAP_VIRIDIS);
        std::array<Colour, 256> entries{};
        for (int i = 0; i < 256; ++i) {
            const cv::Vec3b& bgr = colours(0, i);
            entries[static_cast<std::size_t>(i)] = {bgr[2], bgr[1], bgr[0]};
        }
        return entries;
    }();
    return table;
}

Colour colour_of(double value, double low, double high) {
    const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
    return viridis()[static_cast<std::size_t>(std::lround(share * 255))];
}

} // namespace foam::snapshot
