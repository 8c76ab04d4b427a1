#include "thumbnail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace foam::inline batch {
namespace {

/// A sphere in the picture's frame: right, down, towards the eye.
struct Disc {
    double x, y, depth, radius;
};

std::vector<Disc> discs_of(std::span<const Sphere> spheres) {
    // The eye looks along -(2, 1, 1).
    const Vec3 towards = normalized({2, 1, 1}), right = normalized(cross({0, 0, 1}, towards)),
               up = cross(towards, right);
    std::vector<Disc> discs;
    for (const Sphere& s : spheres) {
        discs.push_back({dot(right, s.center), -dot(up, s.center), dot(towards, s.center), s.radius});
    }
    std::stable_sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.depth < b.depth; });
    return discs;
}

constexpr double edge = 96; // of the picture, pixels

/// Removes discs that others cover, or that are too small to be seen: of a thousand spheres most lie behind or within
/// others. `discs`: in pixels, the farthest first.
void remove_hidden(std::vector<Disc>& discs) {
    constexpr int fine = 2, side = fine * static_cast<int>(edge); // places to look at
    std::vector<char> taken(static_cast<std::size_t>(side) * side, 0);
    const auto place = [&](double pixels) { return std::clamp(static_cast<int>(std::ceil(fine * pixels)), 0, side); };
    const auto takes_any = [&](const Disc& d) {
        bool any = false;
        for (int y = place(d.y - d.radius); y < place(d.y + d.radius); ++y) {
            for (int x = place(d.x - d.radius); x < place(d.x + d.radius); ++x) {
                char& one = taken[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
                const double dx = static_cast<double>(x) / fine - d.x, dy = static_cast<double>(y) / fine - d.y;
                if (one == 0 && dx * dx + dy * dy <= d.radius * d.radius) {
                    one = 1;
                    any = true;
                }
            }
        }
        return any;
    };
    std::vector<Disc> seen;
    std::copy_if(discs.rbegin(), discs.rend(), std::back_inserter(seen), takes_any);
    discs.assign(seen.rbegin(), seen.rend());
}

} // namespace

std::string thumbnail_shading() {
    return "<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs><radialGradient id=\"ball\" cx=\".35\" cy=\".3\" "
           "r=\".8\"><stop offset=\"0\" stop-color=\"#cfe3ff\"/><stop offset=\".6\" stop-color=\"#5b8def\"/><stop "
           "offset=\"1\" stop-color=\"#27408b\"/></radialGradient></defs></svg>\n";
}

std::string thumbnail_svg(std::span<const Sphere> spheres) {
    std::vector<Disc> discs = discs_of(spheres);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double left = infinity, right = -infinity, top = infinity, bottom = -infinity;
    for (const Disc& d : discs) {
        left = std::min(left, d.x - d.radius);
        right = std::max(right, d.x + d.radius);
        top = std::min(top, d.y - d.radius);
        bottom = std::max(bottom, d.y + d.radius);
    }
    const double scale = edge / std::max(right - left, bottom - top);
    if (!std::isfinite(scale)) {
        return "";
    }
    const double x = (edge - scale * (left + right)) / 2, y = (edge - scale * (top + bottom)) / 2;
    for (Disc& d : discs) {
        d = {x + scale * d.x, y + scale * d.y, d.depth, scale * d.radius};
    }
    remove_hidden(discs);
    std::string svg = "<svg width=\"96\" height=\"96\" viewBox=\"0 0 96 96\" role=\"img\" aria-label=\"spheres\">";
    for (const Disc& d : discs) {
        svg +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"url(#ball)\"/>", d.x, d.y, d.radius);
    }
    return svg + "</svg>";
}

} // namespace foam::batch
