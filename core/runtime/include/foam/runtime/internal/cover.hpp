// Elements that cover a shape, on a decimal grid.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/shown_elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <cmath>
#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the approximation in another frame; `pose`: of its frame in that one.
Approximation moved(Approximation approximation, const Pose& pose);
/// Returns the elements as a program holds them that reads its numbers in single precision. Hulls are made again from their
/// rounded vertices. Throws Error(geometry) where these lie in a plane.
Elements in_single_precision(Elements elements);

/// A grid of decimal fractions with step 10^-digits. Its points have a short text and read back to the same bits.
class DecimalGrid {
public:
    /// Chooses a step of about a millionth of `size`.
    explicit DecimalGrid(double size) {
        const int exponent = size > 0 ? static_cast<int>(std::floor(std::log10(size))) - 6 : -9;
        // Powers of ten up to 10^22 are exact doubles; a part smaller than 10^-15 m keeps its digits.
        scale_ = exponent < -22 || exponent > 0 ? 0 : std::pow(10.0, -exponent);
    }
    /// Returns the distance of neighbouring points along an axis, m; 0: all numbers are points.
    double step() const { return scale_ == 0 ? 0 : 1 / scale_; }
    double nearest(double value) const { return scale_ == 0 ? value : std::round(value * scale_) / scale_ + 0.0; }
    Vec3 nearest(const Vec3& v) const { return {nearest(v.x), nearest(v.y), nearest(v.z)}; }
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
    /// Returns for a nonnegative value a grid value that is not above it; 0 below the grid's step.
    double down(double value) const {
        if (scale_ == 0) {
            return value;
        }
        const double steps = std::floor(value * scale_);
        return steps / scale_ <= value ? steps / scale_ : (steps - 1) / scale_;
    }

private:
    double scale_ = 0;
};

/// Returns the volume that the guarantee aims to minimise, once it is kept, m³. Outer: excess volume of the grown
/// spheres. Inner: missing volume of the shrunk spheres. Fitted: symmetric difference. Missing volume is sampled along
/// lines that are the same for all spheres of a solid.
double cost_volume(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);
/// Returns the same for elements of any kind. Precondition: spheres alone with guarantee inner.
double cost_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee);

/// Returns the protrusion once the guarantee is kept, m: the largest distance of the exposed surface from the solid.
double covered_protrusion(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);
/// Returns the same for elements of any kind.
double protrusion_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee);

/// Throws Error(geometry) if no sphere of the finest level can lie in the solid: guarantee inner cannot be kept.
void require_room(const Solid& solid, const SphereTree& tree);

struct FinishedTree {
    SphereTree tree;
    double growth = 0;        ///< m; largest growth of a radius of the finest level
    bool one_instead = false; ///< one enclosing sphere replaces spheres with more excess volume
};

/// Returns the tree with the numbers of a file: centres on a decimal grid of about a millionth of the solid's size.
/// Outer: radii grow so that every level covers the solid, and are rounded up on the same grid. Inner: radii shrink so
/// that every level lies in the solid, and are rounded down; spheres that do not fit are left out. Throws
/// Error(geometry) if none remains. `one_may_do`: one enclosing sphere may replace spheres with more excess volume.
/// Elements of other kinds: half lengths as radii; the vertices of a hull lie on the grid in the link's frame. Lengths
/// are rounded up by a little more than readers of orientations lose (1e-12 of the distances). Precondition: spheres
/// alone with guarantee inner.
FinishedTree finished_tree(const Solid& solid, SphereTree tree, Guarantee guarantee, bool one_may_do = true,
                           Numbers numbers = Numbers::float64);

/// Returns the tree of spheres that cover what kept spheres leave of the solid, grown by the rounding of its pieces: beside
/// the kept ones it covers the solid.
SphereTree beside_kept(const Solid& solid, SphereTree others);

/// Returns the tree with all elements grown by `length`, m; radii and half lengths are rounded up on the same grid.
SphereTree padded(const Solid& solid, SphereTree tree, double length);

} // namespace runtime
} // namespace foam
