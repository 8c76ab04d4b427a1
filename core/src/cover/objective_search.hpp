// Covers by other objectives than the least excess.
#pragma once

#include "cover/distance_field.hpp"
#include "cover/minimax.hpp"

#include <foam/host/spherize.hpp>

#include <map>
#include <memory>

namespace foam::cover {

/// What each effort is.
struct ObjectivePlan {
    int field;                 ///< cells of the distance field along the longest extent; twice as many for many balls
    std::size_t directions;    ///< in which a ball's protrusion is looked at
    int evaluations;           ///< of it, for the best centre of a ball
    std::size_t random_starts; ///< beside those by rule
    std::size_t kept;          ///< starts that are gone on with
    int first_rounds, last_rounds;
    int moves; ///< of balls from where they cost least to where they cost most, at most
};
ObjectivePlan plan_of(Effort effort);

/// The cover of least excess and others start from many places and are improved until their dearest ball is as cheap as
/// it gets: by its radius, or by how far it protrudes. The best is taken, so that none is worse by the objective than
/// that of least excess.
class ObjectiveSearch {
public:
    /// The solid must outlive this.
    ObjectiveSearch(const Solid& solid, const SpherizeOptions& options);
    ObjectiveSearch(const ObjectiveSearch&) = delete; ///< its parts refer to each other
    ObjectiveSearch& operator=(const ObjectiveSearch&) = delete;

    /// By at most so many balls, found without those by fewer.
    Cover alone(std::size_t count);
    /// Along the counts of the ladder more balls are never worse by the objective, and no other count is worse than the
    /// rung below it. A search that was stopped is not kept.
    Cover cover(std::size_t count);
    /// What the objective makes of a cover, m.
    double figure(const Cover& cover) const;
    /// Whether the last search was.
    bool was_stopped() const { return stopped_; }

private:
    struct Model {
        Cover cover;
        double figure = 0; ///< m
        Balls balls;
    };
    struct Surface {
        Surface(const Solid& solid, const Frame& frame, std::size_t pieces, std::size_t some);
        FineSkin skin;
        Points some; ///< of its points
    };
    Model rung(std::size_t count);
    Model model_of(Cover cover) const;
    const Surface& surface_for(std::size_t count);
    /// Null where it is not asked.
    const DistanceField* field_for(std::size_t count);
    /// The best of many starts, the given covers among them.
    Model found(std::size_t count, const std::vector<Balls>& covers);
    std::vector<Balls> starts(const Surface& surface, const DistanceField* field, std::size_t count) const;
    Minimax with_moves(const Surface& surface, const BallCost& cost, Minimax best, std::size_t count);
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    SpherizeOptions options_;
    ObjectivePlan plan_;
    Frame frame_;
    CoverSearch least_excess_;
    std::size_t pieces_ = 0; ///< of the surface that is there
    std::unique_ptr<Surface> surface_;
    int resolution_ = 0; ///< of the field that is there
    std::unique_ptr<DistanceField> field_;
    std::map<std::size_t, Model> rungs_;
    bool stopped_ = false;
};

} // namespace foam::cover
