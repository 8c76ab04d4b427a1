// A search for the point of a piece of surface that lies farthest outside all elements.
#pragma once

#include "judge.hpp"

#include <functional>

namespace judge {

/// How far beyond the end of an element is looked, as a share of the piece.
constexpr Real nudge = 1e-9L;

/// A piece of surface: a point for each s and t from 0 to 1; of a triangle only where s + t is at most 1.
struct Patch {
    std::function<Point(Real, Real)> at;
    bool triangle = false;
    Point middle;
    Real reach = 0; ///< no point is farther from the middle
};

/// Asks point by point; remembers the worst.
class Search {
public:
    /// The elements must outlive it. `rounding`: how far a point of the surface may be off.
    Search(const std::vector<Body>& elements, Real rounding);
    /// The same search among those elements that can be the nearest to a point within `reach` of the middle: depths
    /// differ there by at most twice the reach.
    Search near(const Point& middle, Real reach) const;

    /// How far p is out, beyond doubt; 0 or below: it lies in an element.
    Real ask(const Point& p);
    void ask(const Search& other);
    const std::vector<const Body*>& elements() const { return elements_; }
    const std::optional<Objection>& worst() const { return worst_; }

private:
    std::vector<const Body*> elements_;
    Real rounding_;
    std::optional<Objection> worst_;
};

/// Asks a lattice, and climbs from its peaks.
void ask_patch(Search& search, const Patch& patch);
/// Asks just beyond where the triangle leaves elements.
void ask_leaving(Search& search, const Corners& corners);

} // namespace judge
