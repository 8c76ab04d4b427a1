#include "colour_map.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace foam::snapshot {

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
