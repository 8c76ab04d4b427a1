// The searches for spheres: of any solid, of one with many faces, under limits, and for other objectives.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/surface.hpp"
#include "by_spheres/portfolio/portfolio.hpp"
#include "by_spheres/starts/power_cells.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/search/spherize.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace foam::inline search::by_spheres {

/// The search for covering spheres that the size of the solid, the objective and the effort ask for, in a frame in which
/// numbers are accurate. As CoverSearch; each result builds on those with fewer spheres, and all are kept.
class SolidSearch {
public:
    SolidSearch(const Solid& solid, const CoverOptions& options);
    ~SolidSearch();

    SphereCover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Fits spheres to a solid of many triangles, after a search on its coarse solid. Only triangles near the spheres'
/// surface decide how large the spheres must be: runs of triangles well inside one sphere are left out, and the
/// vertices of the coarse solid stand for them. The proof is about all triangles.
class FineFit {
public:
    /// `coarse`: the coarse_solid(). Both must outlive this.
    FineFit(const Solid& solid, const Solid& coarse, Effort effort);

    /// Returns spheres that cover the solid, with the proof: at most as many, each near the given one.
    SphereCover fitted(const std::vector<Sphere>& spheres);

private:
    /// Returns the surface outside all balls that are a little smaller, in small triangles, and the coarse vertices.
    FineSurface skin_around(const std::vector<Sphere>& spheres) const;
    const Occupancy& occupancy();

    const Solid& solid_;
    const Solid& coarse_;
    Frame frame_;
    FitPlan plan_;
    std::optional<Occupancy> occupancy_; ///< of the coarse solid; made on first use
};

/// Searches for covering balls of a solid that satisfy limits. The union shrinks step by step, and after every step
/// each ball is fitted again to its part of the surface, within the limits. So the balls always cover, and steps can
/// ignore points and limits: a ball that has become expensive shrinks, and the parts of its neighbours, and so the
/// neighbours, grow into its former part. (Lloyd's method 1982 with enclosing balls instead of means, in the power
/// diagram.)
class LimitedSearch {
public:
    /// `count`: the most balls. The solid must outlive this.
    LimitedSearch(const Solid& solid, const Frame& frame, Limits limits, std::size_t count, std::uint64_t seed);

    /// Returns the best balls from these, which need neither cover the solid nor satisfy the limits, and from other
    /// starts: the one that looks best is refined. Where no ball can satisfy a limit, as between two planes with too
    /// few balls, some violate it.
    Balls cover(const Balls& start);

private:
    struct Found {
        Balls balls;
        double cost = 0; ///< volume of the union, and a penalty for the protrusion beyond limits; units³
    };
    Found fitted(const Balls& balls);
    Found descended(Found start, int steps, double first_step);
    Balls stepped(const Balls& balls, double length, const Points& directions);

    Limits limits_;
    std::size_t count_;
    std::uint64_t seed_;
    FineSurface skin_;
    Points some_; ///< a subset of its points
    PowerCells cells_;
    std::vector<Points> directions_;
    Points fine_directions_;
    Exposed exposed_;
};

/// Refines the covering balls of least excess, and others, from many starts until their most expensive ball is as cheap
/// as possible: by its radius, or by its protrusion. It takes the best, so the result is never worse by the objective
/// than that of least excess.
class ObjectiveSearch {
public:
    /// The solid must outlive this.
    ObjectiveSearch(const Solid& solid, const CoverOptions& options);
    ObjectiveSearch(const ObjectiveSearch&) = delete; ///< its parts refer to each other
    ObjectiveSearch& operator=(const ObjectiveSearch&) = delete;

    /// Returns at most `count` covering spheres, found without those of smaller counts.
    SphereCover alone(std::size_t count);
    /// Returns the covering spheres. Along the candidate counts, more balls are never worse by the objective; no other
    /// count is worse than the candidate count below it. The result of a stopped search is not kept.
    SphereCover cover(std::size_t count);
    /// Returns the value of the objective for covering spheres, m.
    double figure(const SphereCover& cover) const;
    /// Returns whether the last search was stopped.
    bool was_stopped() const { return stopped_; }

private:
    struct Model {
        SphereCover cover;
        double figure = 0; ///< m
        Balls balls;
    };
    struct Surface {
        Surface(const Solid& solid, const Frame& frame, std::size_t pieces, std::size_t some);
        FineSurface skin;
        Points some; ///< a subset of its points
    };
    Model rung(std::size_t count);
    Model model_of(SphereCover cover) const;
    const Surface& surface_for(std::size_t count);
    /// Returns null where it is not needed.
    const DistanceField* field_for(std::size_t count);
    /// Returns the best from many starts, the given covers among them.
    Model found(std::size_t count, const std::vector<Balls>& covers);
    /// Returns the cheapest of what becomes of the starts; the best few are refined.
    Minimax best_of(const Surface& surface, const BallCost& cost, const std::vector<Balls>& starts, std::size_t count);
    std::vector<Balls> starts(const Surface& surface, const DistanceField* field, std::size_t count) const;
    Minimax with_moves(const Surface& surface, const BallCost& cost, Minimax best, std::size_t count);
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    CoverOptions options_;
    ObjectivePlan plan_;
    Frame frame_;
    SolidSearch least_excess_;
    std::size_t pieces_ = 0; ///< of the current surface
    std::unique_ptr<Surface> surface_;
    int resolution_ = 0; ///< of the current field
    std::unique_ptr<DistanceField> field_;
    std::map<std::size_t, Model> rungs_;
    bool stopped_ = false;
};

} // namespace foam::inline search::by_spheres
