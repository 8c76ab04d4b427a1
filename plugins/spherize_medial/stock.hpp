// The data that all counts of one shape share: frame, cover points, columns, the spheres to choose among and the
// results of reductions.
#pragma once

#include "columns.hpp"
#include "cover_points.hpp"
#include "medial_axis.hpp"
#include "optimise.hpp"
#include "reduction.hpp"
#include "settings.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

/// A part of the surface with its medial spheres, and the results of the reductions on them.
class Region {
public:
    /// Runs the reductions. `counts`: the numbers of balls that are requested later, all of one tier.
    Region(std::vector<Vec3> points, std::span<const Sphere> medial, std::span<const std::size_t> counts,
           const Columns& columns, const Settings& settings, Context& context);

    /// Returns balls that cover the region's points, at most `count` each, in order of cost. Precondition: one of the
    /// counts.
    std::vector<std::vector<Sphere>> candidates(std::size_t count) const;
    const std::vector<Vec3>& points() const { return points_; }

private:
    std::vector<Vec3> points_;
    const Columns& columns_;
    std::map<std::size_t, std::vector<std::vector<Sphere>>> raw_; ///< by count, one per reduction
};

class Stock {
public:
    /// Prepares a tier. Tier 0 is for the smallest counts; each next has twice the points, columns and medial spheres.
    Stock(const Shape& shape, int tier, const Settings& settings, Context& context);

    Stock(const Stock&) = delete; // the medial axis refers to the columns
    Stock& operator=(const Stock&) = delete;

    /// Returns the tier with suitable detail for that many balls.
    static int tier(std::size_t count);

    const Frame& frame() const { return frame_; }
    const std::vector<Vec3>& points() const { return points_; }
    /// Returns the points and more, for the last steps.
    const std::vector<Vec3>& dense_points() const { return dense_points_; }
    const std::vector<Corners>& surface() const { return surface_; }
    const Columns& columns() const { return columns_; }
    /// Returns columns with a quarter of the lines, for choices among many.
    const Columns& coarse_columns() const { return coarse_columns_; }
    /// Returns the spheres for the reductions: medial spheres, or points of a grid with their depth as the radius.
    std::vector<Sphere> spheres() const { return axis_ ? axis_->spheres() : grid_; }
    /// Returns the spheres that contain one of the points; first refines an adaptive medial axis for them.
    std::vector<Sphere> touching(std::span<const Vec3> points, Context& context);
    /// Returns the smallest ball around the whole surface.
    Sphere bounding() const { return bounding_; }

private:
    void make_axis(const Shape& shape, int tier, Context& context);

    Frame frame_;
    std::vector<Corners> surface_;
    Sphere bounding_;
    std::vector<Vec3> points_, dense_points_;
    Columns columns_, coarse_columns_;
    const Settings& settings_;
    std::unique_ptr<MedialAxis> axis_; ///< none if the settings take a grid
    std::vector<Sphere> grid_;
};

/// Returns balls that cover a region, exactly `count` (fewer only if the region has fewer points), as starts for
/// further improvement: the best result of the reductions and, with `optimise`, that of the optimiser. At least one.
/// Shared objects are only read: safe from several threads.
std::vector<std::vector<Sphere>> starts(const Stock& stock, const Region& region, std::size_t count, bool optimise,
                                        const Settings& settings, Context& context);

} // namespace foam::medial
