// Covers that keep to limits.
#pragma once

#include "cover/power_cells.hpp"

#include <foam/solid.hpp>

#include <cstdint>
#include <vector>

namespace foam::cover {

/// Covers of a solid by balls that keep to limits: the union becomes smaller step by step, and after every step each
/// ball is made anew about its part of the surface, within the limits. So there is a cover all the time, and steps need
/// mind neither points nor limits: a ball that has grown dear falls back, and its neighbours' parts, and so they
/// themselves, grow into what it leaves. (Lloyd's method 1982 with enclosing balls for means, in the power diagram.)
class LimitedSearch {
public:
    /// `count`: the most balls. The solid must outlive this.
    LimitedSearch(const Solid& solid, const Frame& frame, Limits limits, std::size_t count, std::uint64_t seed);

    /// From these balls, which need neither hold the solid nor keep to the limits, and from other starts: the one that
    /// looks best is gone on with. What no ball can keep to, as between two planes where balls are too few, some do
    /// not keep to.
    Balls cover(const Balls& start);

private:
    struct Found {
        Balls balls;
        double cost = 0; ///< volume of the union, and a price for what reaches beyond limits; units³
    };
    Found fitted(const Balls& balls);
    Found descended(Found start, int steps, double first_step);
    Balls stepped(const Balls& balls, double length, const Points& directions);

    Limits limits_;
    std::size_t count_;
    std::uint64_t seed_;
    FineSkin skin_;
    Points some_; ///< of its points
    PowerCells cells_;
    std::vector<Points> directions_;
    Points fine_directions_;
    Exposed exposed_;
};

} // namespace foam::cover
