// The plane that cuts bricks into two parts for two small elements.
#pragma once

#include "bricks.hpp"

#include <functional>
#include <limits>
#include <span>

namespace foam::inline search::convex {

/// The price of putting points into one element: its volume in cubic units.
using Price = std::function<double(std::span<const Vec3>)>;
/// The price of putting points into two elements, or into one if the second has none; of `limit` or more, a lower bound
/// that is also `limit` or more.
using PairPrice = std::function<double(std::span<const Vec3>, std::span<const Vec3>, double limit)>;

/// A plane through bricks, with the price of both parts.
struct Cut {
    Plane plane;
    double price = std::numeric_limits<double>::infinity(); ///< infinite: a part is empty
};

/// Appends points in a plane that belong to both parts, besides those where it crosses edges of bricks.
using PointsInPlane = std::function<void(const Plane&, std::vector<Vec3>&)>;

class CutSearch {
public:
    CutSearch(const std::vector<const Brick*>& bricks, const PairPrice& price, PointsInPlane in_plane = {});

    /// Returns the cut by the plane; where its price is `limit` or more, with a bound for it that is, too.
    Cut at(const Plane& plane, double limit = std::numeric_limits<double>::infinity());
    /// Returns the best of the planes across directions spread evenly, at a few offsets each.
    Cut start();
    /// Moves and tilts the plane by shorter and shorter steps, as long as that makes the price less; about as many
    /// planes as `tries`.
    Cut improved(Cut best, int tries);

private:
    void set_points(const std::vector<const Brick*>& bricks);
    /// Sets below_ and above_ to the points of the parts of all bricks, each once.
    void divide(const Plane& plane);

    std::vector<Vec3> points_;                        ///< vertices of the bricks, each once
    std::vector<std::array<std::uint32_t, 2>> edges_; ///< between these, each once
    std::vector<std::uint32_t> corners_, ends_;       ///< the vertices of each brick, one brick after another
    std::vector<double> heights_;
    std::vector<char> in_; ///< of each vertex: 1 for a part below, 2 for one above
    Box box_;
    const PairPrice& price_;
    PointsInPlane in_plane_;
    std::vector<Vec3> below_, above_, both_;
};

} // namespace foam::inline search::convex
