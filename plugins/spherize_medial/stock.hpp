// What all counts of spheres share: settings, points, the medial axis.
#pragma once

#include "columns.hpp"
#include "optimise.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/parameter.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam::medial {

struct Settings {
    enum class Optimiser { variational, simplex, balance };
    /// The source of the spheres for the reductions.
    enum class Source {
        adaptive_axis, ///< a medial axis that is refined where it fits worst (Bradshaw and O'Sullivan 2004)
        static_axis,   ///< the medial axis of evenly spread surface points (Hubbard 1996)
        grid,          ///< points of a grid inside the solid, each with its depth
    };

    Source source = Source::adaptive_axis;
    std::size_t depth = 1, branch = 8;
    std::size_t cover_points = 1000, cover_per_triangle = 5;
    std::size_t site_points = 1000, sites_per_triangle = 1; ///< of the Voronoi diagram
    std::size_t init_spheres = 500, min_spheres = 200;
    double error_factor = 2;
    bool expand = false, merge = false, burst = false, spawn = false, divide = false;
    bool compare_with_fewer = false; ///< more spheres are only used if they have less excess volume than fewer
    bool optimise = false;
    Optimiser optimiser = Optimiser::variational;
    std::size_t tester_points = 42; ///< 0: exact volumes alone
    std::size_t deepest_optimised_level = 1;
    double balance_excess = 0.05;

    static Settings of_medial(const Parameters& parameters);
    static Settings of_hubbard(const Parameters& parameters);
    static Settings of_spawn(const Parameters& parameters);
    static std::vector<Parameter> medial_parameters();
    static std::vector<Parameter> hubbard_parameters();
    static std::vector<Parameter> spawn_parameters();
};

// The adaptive medial axis approximation (Bradshaw and O'Sullivan 2004, "Adaptive medial-axis approximation for
// sphere-tree construction", ACM TOG 23(1), section 4).

/// The vertices inside the solid of the Voronoi diagram of some surface points. Each is the centre of a medial sphere,
/// whose radius is the distance to the points that formed the vertex. Points are added where they improve most: below
/// the sphere that protrudes most, or where the surface is in no sphere.
class MedialAxis {
public:
    /// Prepares the diagram. `surface`: candidates for its points, dense on the surface. `inside`: whether a sphere,
    /// given by centre and radius, counts as inside.
    MedialAxis(std::vector<Vec3> surface, std::function<bool(const Sphere&)> inside);
    ~MedialAxis();
    MedialAxis(const MedialAxis&) = delete;
    MedialAxis& operator=(const MedialAxis&) = delete;

    /// Adds all surface points: their number determines the result, without adaptation (Hubbard 1996, section 4).
    void take_all(Context& context);
    /// Adds surface points until there are `count` spheres, or none protrudes and all of `cover` is covered.
    void refine(std::size_t count, std::span<const Vec3> cover, Context& context);
    /// Adds surface points until at least `count` spheres contain a point of `cover` and the largest protrusion among
    /// these has fallen by `error_factor`.
    void refine_region(std::size_t count, double error_factor, std::span<const Vec3> cover, Context& context);

    std::vector<Sphere> spheres() const;
    /// Returns the spheres that contain one of the points.
    std::vector<Sphere> touching(std::span<const Vec3> points) const;

private:
    struct Diagram;
    std::unique_ptr<Diagram> diagram_;
};

struct CoverOptions {
    std::size_t count = 1000;     ///< points by area
    std::size_t per_triangle = 5; ///< least number on a triangle that is larger than the spacing of the points
};

/// Returns the corners of the surface, which the proof of coverage needs first, and points spread over it by area;
/// local frame. Where corners are denser than the points, one of each neighbourhood stands for the others. The
/// outermost corners are all kept.
std::vector<Vec3> cover_points(const Solid& solid, const Frame& frame, const CoverOptions& options, std::uint64_t seed);

// The data that all counts of one shape share: frame, cover points, columns, the spheres to choose among and the
// results of reductions.

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
