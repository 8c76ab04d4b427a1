// Covers of one solid by 1, 2, 3, … balls, each from those before.
#pragma once

#include "cover/exchange.hpp"
#include "cover/improvement.hpp"

#include <foam/host/spherize.hpp>
#include <foam/random.hpp>

#include <map>

namespace foam::cover {

/// What normal and best efforts are; fast is QuickSearch.
struct Plan {
    int resolution;           ///< cells of the occupancy along the longest extent
    std::size_t points;       ///< on the surface
    std::size_t first_points; ///< of them, that every descent minds
    std::size_t directions;   ///< a ball
    std::size_t starts;       ///< at random, beside those by rule
    std::size_t kept;         ///< starts that are gone on with
    std::size_t kept_of_many; ///< the same of more balls than exchange pieces
    int coarse_steps, fine_steps;
    std::size_t only_split;     ///< counts up to this come from splits alone
    std::size_t most_split;     ///< counts up to this come from splits too
    std::size_t most_exchanged; ///< counts up to this exchange pieces after a descent
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
    };
    struct Starts {
        std::vector<Balls> rough, regular;
    };
    Model model(std::size_t count);
    Starts starts(std::size_t count, const Balls& before) const;
    Balls with_splits(const Balls& before, std::size_t count, std::size_t first, Random& random) const;
    Rated best_of(const Starts& starts, std::size_t count) const;
    /// One ball more than a cover has, by a plane through one of those that waste most.
    Balls one_more(const Balls& cover) const;
    /// Closed, and, of few balls, improved by exchanges.
    Balls settled(const Balls& balls) const;
    Balls fitted(const Balls& balls) const;
    Model finished(const Balls& balls) const;
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    SpherizeOptions options_;
    Plan plan_;
    Problem problem_;
    Skin skin_, coarse_skin_; ///< the same where there are few points anyway
    Points body_;
    Improvement improvement_;
    std::map<std::size_t, Model> models_;
    bool stopped_ = false;
};

} // namespace foam::cover
