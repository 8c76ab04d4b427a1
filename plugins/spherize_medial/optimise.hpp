// Better places for the balls of a cover. Cost is the volume of their union outside the solid (Columns::outside).
#pragma once

#include "columns.hpp"
#include "uncovered.hpp"

#include <foam/context.hpp>
#include <foam/sphere.hpp>

#include <functional>
#include <span>
#include <vector>

namespace foam::medial {

/// Downhill simplex (Nelder and Mead 1965) in space: a point near `start` where `cost` is lower, after at most
/// `evaluations`. `size`: edge of the first simplex.
Vec3 downhill_simplex(const Vec3& start, double size, int evaluations, const std::function<double(const Vec3&)>& cost);

constexpr double surface_resolution = 4e-3; ///< of pieces of the surface, in units of its extent

struct SimplexOptions {
    int sweeps = 4;           ///< at most, over many balls
    int settlings = 24;       ///< of single balls, at most, over few
    int evaluations = 48;     ///< of the cost, a ball and sweep
    double least_gain = 2e-3; ///< the last sweep is one that lowers the cost by a lesser share …
    double shortfall = 1e-3;  ///< … and leaves no ball short of what it must reach by more than this share
};
/// Ball by ball, the centre moves downhill; the radius is the least that holds what no other ball does (Bradshaw and
/// O'Sullivan 2004, section 6). A ball that the others can do without stays as it is.
std::vector<Sphere> simplex(std::vector<Sphere> balls, Uncovered& surface, const Columns& columns,
                            const SimplexOptions& options, Context& context);

/// Takes away balls that the others can stand in for, as long as the cost rises by no more than the share `excess` of
/// the balls' volume (Bradshaw and O'Sullivan 2004, section 6).
std::vector<Sphere> balance(std::span<const Vec3> points, std::vector<Sphere> balls, double excess,
                            const Columns& columns, Context& context);

struct DescentOptions {
    int steps = 120;
    std::size_t directions = 42; ///< points of a sphere on which its exposed area is measured
};

/// All centres and radii at once, by descent on the volume outside the solid under a penalty on points that no ball
/// holds. Variational: the shape derivative of that volume is the exposed area (the objective is that of Wang et al.
/// 2006, "Variational sphere set approximation for solid objects"). The result holds all points.
std::vector<Sphere> variational(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns,
                                const DescentOptions& options, Context& context);

} // namespace foam::medial
