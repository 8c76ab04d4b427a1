// Searches for covering balls under half-space constraints.
#pragma once

#include "cover/starts/power_cells.hpp"

#include <foam/geometry/solid.hpp>

#include <cstdint>
#include <vector>

namespace foam::inline search::cover {

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

} // namespace foam::search::cover
