#include "convex/element_surface.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline geometry {

double area_of(const std::vector<Patch>& patches, double rest) {
    double area = rest;
    for (const Patch& patch : patches) {
        area += patch.area;
    }
    return area;
}

std::size_t share_of(std::size_t count, double area, double whole) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::round(static_cast<double>(count) * area / whole)));
}

void add_points(const std::vector<Patch>& patches, double area, std::size_t count, std::vector<ElementPoint>& points) {
    for (const Patch& patch : patches) {
        if (!(patch.area > 0)) {
            continue;
        }
        const std::size_t own = share_of(count, patch.area, area);
        double second = 0.5;
        for (std::size_t k = 0; k < own; ++k) {
            second += 0.6180339887498949;
            second -= second >= 1 ? 1 : 0;
            ElementPoint p = patch.at((static_cast<double>(k) + 0.5) / static_cast<double>(own), second);
            p.area = patch.area / static_cast<double>(own);
            points.push_back(p);
        }
    }
}

} // namespace foam::inline geometry
