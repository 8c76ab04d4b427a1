#include "by_spheres/measured/occupancy.hpp"

#include <foam/base/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {

DistanceField::DistanceField(const Solid& solid, const Frame& frame, int resolution)
    : half_(solid.bounds().size() / frame.unit / 2) {
    constexpr double margin = 0.2; // units; balls about large parts reach farther, where accuracy matters little
    const double cell = std::max({2 * half_.x, 2 * half_.y, 2 * half_.z, 1.0}) / resolution; // for a single point, too
    cell_ = static_cast<float>(cell);
    for (int k = 0; k < 3; ++k) {
        const int beyond = static_cast<int>(std::ceil((half_[k] + margin) / cell));
        count_[k] = 2 * beyond + 1;
        low_[k] = static_cast<float>(-beyond * cell);
    }
    const auto row = static_cast<std::size_t>(count_[0]);
    distance_.resize(row * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]));
    parallel_for(distance_.size() / row, [&](std::size_t r) {
        for (std::size_t node = r * row; node < (r + 1) * row; ++node) {
            distance_[node] = static_cast<float>(solid.signed_distance(frame.from_unit(place(node))) / frame.unit);
        }
    });
}

Vec3 DistanceField::place(std::size_t node) const {
    const auto x = static_cast<std::size_t>(count_[0]), y = static_cast<std::size_t>(count_[1]);
    const double cell = cell_;
    return {low_[0] + cell * static_cast<double>(node % x), low_[1] + cell * static_cast<double>(node / x % y),
            low_[2] + cell * static_cast<double>(node / x / y)};
}

float DistanceField::at(float x, float y, float z) const {
    const float p[3]{x, y, z};
    int first[3];
    float share[3], beyond = 0;
    for (int k = 0; k < 3; ++k) {
        const float f = (p[k] - low_[k]) / cell_;
        const float on = std::clamp(f, 0.0f, static_cast<float>(count_[k] - 1));
        first[k] = std::min(static_cast<int>(on), count_[k] - 2);
        share[k] = on - static_cast<float>(first[k]);
        beyond += (f - on) * (f - on);
    }
    const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
    const auto row = static_cast<std::size_t>(count_[0]), slice = row * static_cast<std::size_t>(count_[1]);
    const float* c = distance_.data() + static_cast<std::size_t>(first[0]) + row * static_cast<std::size_t>(first[1]) +
                     slice * static_cast<std::size_t>(first[2]);
    const float* d = c + slice;
    const float a = mix(mix(c[0], c[1], share[0]), mix(c[row], c[row + 1], share[0]), share[1]);
    const float b = mix(mix(d[0], d[1], share[0]), mix(d[row], d[row + 1], share[0]), share[1]);
    return mix(a, b, share[2]) + (beyond > 0 ? std::sqrt(beyond) * cell_ : 0);
}

DistanceField::Nodes DistanceField::nodes_within_bounds(std::size_t most) const {
    std::vector<std::size_t> within;
    for (std::size_t node = 0; node < distance_.size(); ++node) {
        const Vec3 p = place(node);
        const double slack = cell_ / 2;
        if (std::abs(p.x) <= half_.x + slack && std::abs(p.y) <= half_.y + slack && std::abs(p.z) <= half_.z + slack) {
            within.push_back(node);
        }
    }
    Nodes nodes;
    const std::size_t count = std::min(most, within.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t node = within[i * within.size() / count];
        nodes.places.add(place(node));
        nodes.distance.push_back(distance_[node]);
    }
    return nodes;
}

} // namespace foam::search::by_spheres
