// Searches for covering balls of one solid, 1, 2, 3, …, each from the smaller counts.
#pragma once

#include "by_spheres/moves/moves.hpp"
#include "by_spheres/portfolio/portfolio.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/portfolio/quick_search.hpp"

#include <foam/base/random.hpp>
#include <foam/search/refine.hpp>
#include <foam/search/spherize.hpp>

#include <map>
#include <optional>

namespace foam::inline search::by_spheres {

class Search {
public:
    /// The solid must outlive this.
    Search(const Solid& solid, const CoverOptions& options) : Search(solid, options, portfolio_of(options.effort).search) {}
    Search(const Solid& solid, const CoverOptions& options, const Plan& plan);
    Search(const Search&) = delete; ///< its parts refer to each other
    Search& operator=(const Search&) = delete;

    /// Returns the covering spheres for a count. The result of a stopped search is not kept.
    SphereCover cover(std::size_t count) {
        stopped_ = false;
        return model(count).cover;
    }
    /// Returns whether the last search was stopped.
    bool was_stopped() const { return stopped_; }

private:
    struct Model {
        Balls balls;
        SphereCover cover;
        double joint; ///< volume of the spheres and the solid together, m³
    };
    Model model(std::size_t count);
    /// Makes the balls the model if they are better.
    void take(Model& best, const Balls& balls) const;
    /// Improves the model by rounds of moves of every ball.
    void move_all(Model& best, std::size_t count);
    /// Returns one ball more: a plane splits one of those with most excess volume.
    Balls one_more(const Balls& cover) const;
    /// Returns sets of balls for a count above most_growing.
    std::vector<Balls> found_of_many(std::size_t count);
    /// Returns sets of as many balls: for each ball in turn, the ball is removed, and one with most excess volume is
    /// split.
    std::vector<Balls> moved(const Balls& cover);
    /// Returns balls split in two one after another, those where it helps, until there are `count`.
    Balls grown(const Model& cover, std::size_t count);
    /// Returns `count` balls merged from more; none if there are no such.
    Balls merged(const DescentSurface& surface, std::size_t count);
    /// Returns sets of balls, larger than `before`, that cover the surface or nearly do. `joint`: of the best model so
    /// far.
    std::vector<Balls> found(std::size_t count, const Model& before, double joint);
    std::vector<CoverCandidate> starts_of_some(std::size_t count, const Balls& before);
    std::vector<CoverCandidate> starts_of_many(std::size_t count);
    /// Removes candidates that are too far behind the best model for exchanges to make up for it.
    void drop_hopeless(std::vector<CoverCandidate>& candidates, double joint) const;
    /// Adds candidates from many random starts.
    void add_restarts(std::size_t count, std::vector<CoverCandidate>& rated);
    Balls exchanged(const Balls& balls) const;
    Balls exchanged_finely(const Balls& balls) const;
    /// Returns the balls after long steps, which move lost ones to better places.
    Balls moved_far(const Balls& balls) const;
    Balls refined(const Balls& balls) const;
    CoverCandidate settled(const DescentSurface& surface, const Balls& balls, int steps) const;
    Model finished(const Balls& balls) const;
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    CoverOptions options_;
    Plan plan_;
    Problem problem_;
    IndexedSurface skin_, coarse_skin_; ///< the same where there are few points
    Points body_; ///< more than six a ball: fewer would make clusters of one point, balls without size
    Improvement improvement_;
    std::optional<Splitting> splitting_; ///< made on first use
    QuickSearch quick_;
    std::map<std::size_t, std::vector<Balls>> merged_; ///< by the number of balls before merging
    std::map<std::size_t, Model> models_;
    bool stopped_ = false;
};

} // namespace foam::inline search::by_spheres
