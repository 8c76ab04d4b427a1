// Searches for covering balls in milliseconds.
#pragma once

#include "by_spheres/descent/descent.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/power_cells.hpp"

#include <foam/search/spherize.hpp>

#include <map>
#include <memory>
#include <optional>

namespace foam::inline search::by_spheres {

/// Descends from a few starts on some points of the surface, and refines the best on more points. Finally it fits the
/// balls to their parts of the surface, which makes any balls cover.
class QuickSearch {
public:
    /// The solid must outlive this.
    QuickSearch(const Solid& solid, const CoverOptions& options);

    /// Returns at most `count` covering spheres, found without those of smaller counts.
    SphereCover alone(std::size_t count);
    /// Returns the covering spheres. Along the candidate counts, more balls never have more excess volume; no other
    /// count has more than the candidate count below it. The result of a stopped search is not kept.
    SphereCover cover(std::size_t count) {
        stopped_ = false;
        return rung(count).cover;
    }
    /// Returns whether the last search was stopped.
    bool was_stopped() const { return stopped_; }

    /// Returns balls for another search to refine: they cover the surface and start from the balls for a smaller count
    /// and from others; the best few, best first. At least two balls. The volume is that of their union, plus for many
    /// balls the missing volume of the solid.
    std::vector<CoverCandidate> candidates(std::size_t count, const Balls& before);
    /// Returns the same for the better of grids and of the given balls.
    CoverCandidate candidate(std::size_t count, const Balls& more);
    const DescentSurface& surface_for(std::size_t count);

private:
    struct Rung {
        Balls balls;
        SphereCover cover;
    };
    Rung rung(std::size_t count);
    /// Returns the occupancy of the solid if there are so many balls that they may leave a cavity in it.
    const Occupancy* occupancy_for(std::size_t count);
    /// Returns the results, the best first, at least one. `before`: covering balls of a smaller count to start with, if
    /// any.
    std::vector<CoverCandidate> found(std::size_t count, const Balls* before);
    std::vector<CoverCandidate> found_quickly(std::size_t count, const Balls* before);
    /// Returns the results from the best `kept` of these starts, at least one, the best first.
    std::vector<CoverCandidate> refined_best(std::size_t count, std::vector<Balls> starts, std::size_t kept);
    /// Returns the results for many balls, the best first, by the volume of balls and solid together, m³. None around
    /// needles, which the occupancy misses, and if the search was stopped before there were any.
    std::vector<CoverCandidate> many(std::size_t count);
    std::vector<Balls> starts(const DescentSurface& surface, const Occupancy* occupancy, std::size_t count,
                              const Balls* before) const;
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    CoverOptions options_;
    Frame frame_;
    std::size_t pieces_ = 0; ///< of the current surface
    std::unique_ptr<DescentSurface> surface_;
    std::unique_ptr<Occupancy> occupancy_;
    std::optional<Problem> problem_; ///< of many balls
    std::size_t problem_count_ = 0;  ///< the count it was made for
    bool stopped_ = false;
    std::map<std::size_t, Rung> rungs_;
};

} // namespace foam::search::by_spheres
