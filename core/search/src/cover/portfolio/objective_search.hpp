// Searches for covering spheres by objectives other than excess.
#pragma once

#include "cover/measured/distance_field.hpp"
#include "cover/starts/minimax.hpp"

#include <foam/search/spherize.hpp>

#include <map>
#include <memory>

namespace foam::inline search::cover {

/// The parameters of an effort.
struct ObjectivePlan {
    int field;                 ///< cells of the distance field along the longest extent; twice as many for many balls
    std::size_t directions;    ///< directions in which a ball's protrusion is evaluated
    int evaluations;           ///< evaluations of the cost, for the best centre of a ball
    std::size_t random_starts; ///< in addition to the rule-based starts
    std::size_t kept;          ///< starts that are refined
    int first_rounds, last_rounds;
    int moves; ///< most moves of balls from the lowest cost to the highest
};
ObjectivePlan plan_of(Effort effort);

/// Refines the covering balls of least excess, and others, from many starts until their most expensive ball is as cheap
/// as possible: by its radius, or by its protrusion. It takes the best, so the result is never worse by the objective
/// than that of least excess.
class ObjectiveSearch {
public:
    /// The solid must outlive this.
    ObjectiveSearch(const Solid& solid, const SpherizeOptions& options);
    ObjectiveSearch(const ObjectiveSearch&) = delete; ///< its parts refer to each other
    ObjectiveSearch& operator=(const ObjectiveSearch&) = delete;

    /// Returns at most `count` covering spheres, found without those of smaller counts.
    Cover alone(std::size_t count);
    /// Returns the covering spheres. Along the candidate counts, more balls are never worse by the objective; no other
    /// count is worse than the candidate count below it. The result of a stopped search is not kept.
    Cover cover(std::size_t count);
    /// Returns the value of the objective for covering spheres, m.
    double figure(const Cover& cover) const;
    /// Returns whether the last search was stopped.
    bool was_stopped() const { return stopped_; }

private:
    struct Model {
        Cover cover;
        double figure = 0; ///< m
        Balls balls;
    };
    struct Surface {
        Surface(const Solid& solid, const Frame& frame, std::size_t pieces, std::size_t some);
        FineSurface skin;
        Points some; ///< a subset of its points
    };
    Model rung(std::size_t count);
    Model model_of(Cover cover) const;
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
    SpherizeOptions options_;
    ObjectivePlan plan_;
    Frame frame_;
    CoverSearch least_excess_;
    std::size_t pieces_ = 0; ///< of the current surface
    std::unique_ptr<Surface> surface_;
    int resolution_ = 0; ///< of the current field
    std::unique_ptr<DistanceField> field_;
    std::map<std::size_t, Model> rungs_;
    bool stopped_ = false;
};

} // namespace foam::search::cover
