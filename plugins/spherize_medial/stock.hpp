// What all counts of one shape share: frame, cover points, columns, the spheres to choose among and what reductions
// make of them.
#pragma once

#include "columns.hpp"
#include "cover_points.hpp"
#include "medial_axis.hpp"
#include "optimise.hpp"
#include "reduction.hpp"
#include "settings.hpp"

#include <foam/context.hpp>
#include <foam/solid.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

/// Part of the surface with the medial spheres that concern it, and what the reductions make of them.
class Region {
public:
    /// `counts`: the numbers of balls that will be asked for, all of one tier.
    Region(std::vector<Vec3> points, std::span<const Sphere> medial, std::span<const std::size_t> counts,
           const Columns& columns, const Settings& settings, Context& context);

    /// Covers of the region's points by at most `count` balls, the cheapest first. Precondition: one of the counts.
    std::vector<std::vector<Sphere>> candidates(std::size_t count) const;
    const std::vector<Vec3>& points() const { return points_; }

private:
    std::vector<Vec3> points_;
    const Columns& columns_;
    std::map<std::size_t, std::vector<std::vector<Sphere>>> raw_; ///< by count, one a reduction
};

class Stock {
public:
    /// `tier` 0 is for the smallest counts; each next has twice the points, columns and medial spheres.
    Stock(const Shape& shape, int tier, const Settings& settings, Context& context);

    Stock(const Stock&) = delete; // the medial axis refers to the columns
    Stock& operator=(const Stock&) = delete;

    /// The tier whose detail suits that many balls.
    static int tier(std::size_t count);

    const Frame& frame() const { return frame_; }
    const std::vector<Vec3>& points() const { return points_; }
    /// The points and more, for the last steps.
    const std::vector<Vec3>& dense_points() const { return dense_points_; }
    const std::vector<Corners>& surface() const { return surface_; }
    const Columns& columns() const { return columns_; }
    /// The same with a quarter of the lines, for choices among many.
    const Columns& coarse_columns() const { return coarse_columns_; }
    /// What the reductions choose among: medial spheres, or points of a grid with their depth as the radius.
    std::vector<Sphere> spheres() const { return axis_ ? axis_->spheres() : grid_; }
    /// Those that hold one of the points; an adaptive medial axis is refined for them first.
    std::vector<Sphere> touching(std::span<const Vec3> points, Context& context);
    /// Smallest ball around the whole surface.
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

/// Covers of a region by exactly `count` balls (fewer only where the region has not that many points), to be improved
/// further: what the reductions found at best and, if `optimise`, what the optimiser made of it. At least one. Shared
/// objects are only read: safe from several threads.
std::vector<std::vector<Sphere>> starts(const Stock& stock, const Region& region, std::size_t count, bool optimise,
                                        const Settings& settings, Context& context);

} // namespace foam::medial
