#include "cover.hpp"

#include <foam/measure.hpp>

#include <cmath>

namespace foam {
namespace {

/// A grid of decimal fractions 10^-digits. Its points print short and read back to the same bits.
class DecimalGrid {
public:
    /// About a millionth of `size`.
    explicit DecimalGrid(double size) {
        const int exponent = size > 0 ? static_cast<int>(std::floor(std::log10(size))) - 6 : -9;
        // Powers of ten up to 10^22 are exact doubles; a part smaller than 10^-15 m keeps its digits.
        scale_ = exponent < -22 || exponent > 0 ? 0 : std::pow(10.0, -exponent);
    }
    double nearest(double value) const { return scale_ == 0 ? value : std::round(value * scale_) / scale_ + 0.0; }
    double up(double value) const {
        if (scale_ == 0) {
            return value;
        }
        double rounded = std::ceil(value * scale_) / scale_;
        while (rounded < value) {
            rounded = (std::round(rounded * scale_) + 1) / scale_;
        }
        return rounded;
    }

private:
    double scale_ = 0;
};

} // namespace

double wrong_volume(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee) {
    if (guarantee == Guarantee::outer) {
        spheres = grown_to_cover(solid, std::move(spheres));
        return std::max(0.0, union_volume(spheres) - solid.volume());
    }
    MeasureOptions options;
    options.surface_points = 1'000;
    options.volume_rays = 3'000;
    options.volume_points = 20'000;
    options.directions_per_sphere = 10;
    const Measures measures = measure(solid, spheres, options);
    return (measures.excess + measures.missing) * measures.volume;
}

double covered_protrusion(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee) {
    if (guarantee == Guarantee::outer) {
        spheres = grown_to_cover(solid, std::move(spheres));
    }
    MeasureOptions options;
    options.surface_points = 1'000;
    options.volume_rays = 300;
    options.volume_points = 1'000;
    return measure(solid, spheres, options).protrusion_max;
}

FinishedTree finished_tree(const Solid& solid, SphereTree tree, Guarantee guarantee) {
    const DecimalGrid grid(solid.bounds().diagonal());
    FinishedTree result;
    for (SphereTree::Level& level : tree.levels) {
        for (Sphere& sphere : level.spheres) {
            sphere.center = {grid.nearest(sphere.center.x), grid.nearest(sphere.center.y),
                             grid.nearest(sphere.center.z)};
        }
        const std::vector<Sphere> before = level.spheres;
        if (guarantee == Guarantee::outer) {
            level.spheres = grown_to_cover(solid, std::move(level.spheres));
        }
        result.growth = 0;
        for (std::size_t i = 0; i < level.spheres.size(); ++i) {
            level.spheres[i].radius = grid.up(level.spheres[i].radius);
            result.growth = std::max(result.growth, level.spheres[i].radius - before[i].radius);
        }
    }
    result.tree = std::move(tree);
    return result;
}

} // namespace foam
