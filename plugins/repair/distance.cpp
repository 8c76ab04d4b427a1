#include "distance.hpp"

#include <foam/parallel.hpp>
#include <foam/solid.hpp>

namespace foam::watertight {

Distances sampled_distance(const Mesh& from, const Mesh& to, std::uint64_t seed) {
    constexpr std::size_t count = 1000;
    const std::shared_ptr<const Solid> target = Solid::make(to);
    const std::vector<SurfacePoint> points = Solid::make(from)->sample_surface(count, seed);
    std::vector<double> distances(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        distances[i] = distance(points[i].point, target->closest(points[i].point).point);
    });
    Distances result;
    for (const double d : distances) {
        result.max = std::max(result.max, d);
        result.mean += d / static_cast<double>(distances.size());
    }
    return result;
}

} // namespace foam::watertight
