// Covers of one solid by 1, 2, 3, … balls, each from those before.
#pragma once

#include "cover/exchange.hpp"
#include "cover/improvement.hpp"
#include "cover/quick_search.hpp"
#include "cover/splitting.hpp"

#include <foam/host/spherize.hpp>
#include <foam/random.hpp>

#include <map>
#include <optional>

namespace foam::cover {

/// What normal and best efforts are; fast is QuickSearch.
struct Plan {
    int resolution;               ///< cells of the occupancy along the longest extent
    std::size_t points;           ///< on the surface
    std::size_t first_points;     ///< of them, that every descent minds
    std::size_t directions;       ///< a ball
    std::size_t restarts, starts; ///< at random: of as many balls as the quick search looks for too, and of more
    std::size_t kept_of_few, kept_of_some, kept_of_many; ///< starts that are gone on with: up to 4, up to most_quick
    int coarse_steps, fine_steps;
    std::size_t most_split;     ///< counts up to this come from splits too; two balls from them alone
    int most_moves;             ///< rounds of moves of those, each of every ball
    std::size_t most_grown;     ///< more, up to this, come from those before with balls split one by one
    std::size_t most_quick;     ///< counts up to this begin with what the quick search finds
    std::size_t most_exchanged; ///< counts up to this exchange pieces
    int first_gradient_steps, last_gradient_steps; ///< of each start, and of those that are kept
    ExchangePlan exchange;
    int skin_resolution; ///< of a finely meshed surface, for the search
};
Plan plan_for(Effort effort);

class Search {
public:
    /// The solid must outlive this.
    Search(const Solid& solid, const SpherizeOptions& options);
    Search(const Search&) = delete; ///< its parts refer to each other
    Search& operator=(const Search&) = delete;

    /// A search that was stopped is not kept.
    Cover cover(std::size_t count) {
        stopped_ = false;
        return model(count).cover;
    }
    /// Whether the last search was.
    bool was_stopped() const { return stopped_; }

private:
    struct Model {
        Balls balls;
        Cover cover;
        double joint; ///< volume of the cover and the solid together, m³
    };
    Model model(std::size_t count);
    /// One ball more than a cover has, by a plane through one of those that waste most.
    Balls one_more(const Balls& cover) const;
    /// Covers by as many balls: of each ball in turn the place is given up, and one that wastes most is split.
    std::vector<Balls> moved(const Balls& cover);
    /// A cover with one ball after the other split in two, those that are worth it, until there are `count`.
    Balls grown(const Model& cover, std::size_t count);
    /// Covers, or all but that, by more balls than `before`; `more`, if there is any, is one that is to become better.
    std::vector<Balls> found(std::size_t count, const Balls& before, const Balls& more);
    /// Candidates from many random starts.
    void add_restarts(std::size_t count, std::vector<Rated>& rated);
    void add_starts_of_many(std::size_t count, std::vector<Rated>& rated);
    std::size_t kept_for(std::size_t count) const;
    Balls exchanged(const Balls& balls) const;
    Balls exchanged_finely(const Balls& balls) const;
    Balls refined(const Balls& balls) const;
    Rated settled(const DescentSurface& surface, const Balls& balls, int steps) const;
    Model finished(const Balls& balls) const;
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    SpherizeOptions options_;
    Plan plan_;
    Problem problem_;
    Skin skin_, coarse_skin_; ///< the same where there are few points anyway
    Points body_;
    Improvement improvement_;
    std::optional<Splitting> splitting_; ///< once it is needed
    QuickSearch quick_;
    std::map<std::size_t, Model> models_;
    bool stopped_ = false;
};

} // namespace foam::cover
