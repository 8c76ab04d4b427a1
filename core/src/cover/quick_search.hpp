// Covers in milliseconds.
#pragma once

#include "cover/power_cells.hpp"
#include "cover/rated.hpp"
#include "cover/surface_descent.hpp"

#include <foam/host/spherize.hpp>

#include <map>
#include <memory>

namespace foam::cover {

/// A few starts, a descent of each on some points of the surface, the best gone on with on more of them. In the end
/// balls are fitted to their parts of the surface, which makes a cover of whatever they are.
class QuickSearch {
public:
    /// The solid must outlive this.
    QuickSearch(const Solid& solid, const SpherizeOptions& options);

    /// By at most so many balls, found without those by fewer.
    Cover alone(std::size_t count);
    /// Along the counts of the ladder more balls never claim more, and no other count claims more than the rung below
    /// it.
    /// A search that was stopped is not kept.
    Cover cover(std::size_t count) {
        stopped_ = false;
        return rung(count).cover;
    }
    /// Whether the last search was.
    bool was_stopped() const { return stopped_; }

    /// For another search to go on with: balls that hold the surface, begun with a cover by fewer and otherwise; the
    /// best few, best first. At least two balls. The volume is that of their union, and of many balls with what they
    /// miss of the solid.
    std::vector<Rated> candidates(std::size_t count, const Balls& before);
    const DescentSurface& surface_for(std::size_t count);

private:
    struct Rung {
        Balls balls;
        Cover cover;
    };
    Rung rung(std::size_t count);
    /// Of the solid, if balls are so many that they may leave a hollow in it.
    const Occupancy* occupancy_for(std::size_t count);
    /// `before`: a cover by fewer to begin with, if there is one. The best first; at least one.
    std::vector<Rated> found(std::size_t count, const Balls* before);
    std::vector<Balls> starts(const DescentSurface& surface, const Occupancy* occupancy, std::size_t count,
                              const Balls* before) const;
    Rated first_look(const DescentSurface& surface, const Occupancy* occupancy, Balls balls) const;
    Rated gone_on_with(const DescentSurface& surface, const Occupancy* occupancy, const Rated& start,
                       std::size_t count) const;
    bool stopped() { return stopped_ = stopped_ || (options_.stop && options_.stop()); }

    const Solid& solid_;
    SpherizeOptions options_;
    Frame frame_;
    std::size_t pieces_ = 0; ///< of the surface that is there
    std::unique_ptr<DescentSurface> surface_;
    std::unique_ptr<Occupancy> occupancy_;
    bool stopped_ = false;
    std::map<std::size_t, Rung> rungs_;
};

} // namespace foam::cover
