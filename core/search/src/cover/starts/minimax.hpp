// Covering balls with the least largest cost.
#pragma once

#include "cover/descent/ball_cost.hpp"
#include "cover/starts/power_cells.hpp"

namespace foam::inline search::cover {

/// Covering balls, the cost of each, and the largest cost.
struct Minimax {
    Balls balls;
    std::vector<double> costs;
    double worst = 0;

    std::size_t dearest() const;
};

/// Lloyd's iteration (1982) for the maximum instead of the mean. All balls grow until they cost as much as the most
/// expensive one, the surface is divided among them by power, and the cheapest ball that contains its part replaces
/// each. As the grown balls contain their parts, the largest cost never rises. With the radius as cost, these are the
/// alternating steps of the k-centre problem, with smallest enclosing balls of Voronoi cells.
class MinimaxSearch {
public:
    /// Both must outlive this.
    MinimaxSearch(const FineSurface& skin, const BallCost& cost) : cells_(skin), cost_(cost) {}

    /// Returns covering balls, at most `count`. Balls without a part move to the most expensive ball.
    Minimax improved(const Balls& start, std::size_t count, int rounds);
    /// Returns the result with ball `i` removed and the most expensive ball split in two.
    Minimax moved(const Minimax& cover, std::size_t i, int rounds);
    /// Returns balls of the same cost and less volume: they tilt where that reduces it, as long as none costs more than
    /// the most expensive ball.
    Minimax leaner(const Minimax& cover, const Points& directions, int rounds);

private:
    Minimax fitted(const Balls& balls);
    Balls grown(const Minimax& cover) const;
    /// Returns the balls with the most expensive one split in two.
    Balls with_split(const Minimax& cover);

    PowerCells cells_;
    const BallCost& cost_;
};

} // namespace foam::search::cover
