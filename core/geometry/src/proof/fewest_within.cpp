#include <foam/geometry/cell.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>

namespace foam::inline geometry {

SphereTree fewest_within(const Solid& solid, double limit, std::size_t most,
                         const std::function<SphereTree(std::size_t)>& make) {
    const auto holds = [&](const SphereTree& tree) {
        MeasureOptions options;
        options.surface_points = 1'000;
        options.volume_rays = 300;
        options.volume_points = 1'000;
        return measure(solid, grown_to_cover(solid, tree.finest()), options).protrusion_max <= limit;
    };
    std::size_t low = 1, high = 1;
    SphereTree best = make(high);
    while (!holds(best)) {
        if (high >= most) {
            return best;
        }
        low = high + 1;
        high = std::min(2 * high, most);
        best = make(high);
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        SphereTree tree = make(middle);
        if (holds(tree)) {
            best = std::move(tree);
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return best;
}

} // namespace foam::geometry
