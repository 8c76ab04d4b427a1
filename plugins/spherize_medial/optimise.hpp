// Better positions for covering balls. The cost is the volume of their union outside the solid (Columns::outside).
#pragma once

#include "columns.hpp"
#include "uncovered.hpp"

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <span>
#include <vector>

namespace foam::medial {

constexpr double surface_resolution = 4e-3; ///< of pieces of the surface, in units of its extent

struct SimplexOptions {
    int sweeps = 4;           ///< at most, over many balls
    int settlings = 24;       ///< of single balls, at most, over few
    int evaluations = 48;     ///< of the cost, per ball and sweep
    double least_gain = 2e-3; ///< the last sweep lowers the cost by a smaller share …
    double shortfall = 1e-3;  ///< … and leaves no ball short of its required reach by more than this share
};
/// Improves ball by ball: the centre moves downhill, and the radius is the least that contains what no other ball does
/// (Bradshaw and O'Sullivan 2004, section 6). A redundant ball stays unchanged.
std::vector<Sphere> simplex(std::vector<Sphere> balls, Uncovered& surface, const Columns& columns,
                            const SimplexOptions& options, Context& context);

/// Removes balls that the others can replace, as long as the cost rises by at most the share `excess` of the balls'
/// volume (Bradshaw and O'Sullivan 2004, section 6).
std::vector<Sphere> balance(std::span<const Vec3> points, std::vector<Sphere> balls, double excess,
                            const Columns& columns, Context& context);

struct DescentOptions {
    int steps = 120;
    std::size_t directions = 42; ///< points of a sphere on which its exposed area is measured
};

/// Improves all centres and radii at once, by descent on the volume outside the solid with a penalty on points in no
/// ball. Variational: the shape derivative of that volume is the exposed area (the objective is that of Wang et al.
/// 2006, "Variational sphere set approximation for solid objects"). The result contains all points.
std::vector<Sphere> variational(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns,
                                const DescentOptions& options, Context& context);

} // namespace foam::medial
