// Means with their standard errors, and two models of a robot compared query by query.
#pragma once

#include "engine.hpp"

#include <cstddef>

namespace foam::inline bench {

/// Mean of what was added, by Welford's method (1962).
class Mean {
public:
    void add(double value);
    std::size_t count() const { return count_; }
    double value() const; ///< NaN of nothing
    double error() const; ///< standard error of the mean; NaN of fewer than two

private:
    std::size_t count_ = 0;
    double mean_ = 0, squares_ = 0; ///< squares: sum of squared deviations from the mean
};

/// A quantity of the original, of the spheres, and the spheres' minus the original's, over the same queries.
struct Paired {
    Mean original, spheres, difference;
    void add(double of_original, double of_spheres);
};

/// In which queries a condition holds for the original and for the spheres.
struct Verdicts {
    std::size_t holds[2] = {0, 0}; ///< by model
    std::size_t only_original = 0, only_spheres = 0;
    Mean difference; ///< of the share of queries, spheres minus original
    void add(bool of_original, bool of_spheres);
};

/// What an engine says of two models, over the queries that it answered for both.
struct EngineComparison {
    std::size_t aborted[2] = {0, 0}; ///< by model
    std::size_t not_asked = 0;       ///< queries
    Paired move, collision;          ///< CPU s
    Paired distance;                 ///< CPU s
    Paired metres;                   ///< the distance itself, where neither model collides
    Verdicts collides;               ///< with an obstacle, or with itself
    Verdicts hits_obstacle, hits_itself;

    std::size_t queries() const { return collision.original.count(); }
};

EngineComparison compare_models(const std::vector<std::array<EngineAnswer, 2>>& answers);

/// Of the queries where the exact original hits an obstacle (itself): those in which the spheres of an engine do not.
struct Missed {
    std::size_t obstacle_hits = 0, obstacles = 0, self_hits = 0, selves = 0;
};
Missed missed_by(const std::vector<std::array<EngineAnswer, 2>>& answers,
                 const std::vector<std::array<EngineAnswer, 2>>& exact);

} // namespace foam::bench
