// Covers of which the dearest ball is as cheap as can be.
#pragma once

#include "cover/ball_cost.hpp"
#include "cover/power_cells.hpp"

namespace foam::cover {

/// A cover, what each ball of it costs, and the most that one does.
struct Minimax {
    Balls balls;
    std::vector<double> costs;
    double worst = 0;

    std::size_t dearest() const;
};

/// Lloyd's iteration (1982) for the worst instead of the mean: all balls grow until they cost what the dearest does,
/// the surface is shared among them by power, and each gives way to the cheapest ball that holds its part. As the grown
/// balls hold their parts, the worst cost never rises. By the radius these are the alternate steps of the k-centre
/// problem, with smallest enclosing balls of Voronoi cells.
class MinimaxSearch {
public:
    /// Both must outlive this.
    MinimaxSearch(const FineSkin& skin, const BallCost& cost) : cells_(skin), cost_(cost) {}

    /// A cover by at most `count` balls; where they own nothing they are put where the dearest is.
    Minimax improved(const Balls& start, std::size_t count, int rounds);
    /// The same from a cover with ball `i` taken away and the dearest one split in two.
    Minimax moved(const Minimax& cover, std::size_t i, int rounds);
    /// The same cost with less volume: balls lean to where it pays, as far as none comes to cost more than the dearest.
    Minimax leaner(const Minimax& cover, const Points& directions, int rounds);

private:
    Minimax fitted(const Balls& balls);
    Balls grown(const Minimax& cover) const;
    /// With the ball of most cost split in two.
    Balls with_split(const Minimax& cover);

    PowerCells cells_;
    const BallCost& cost_;
};

} // namespace foam::cover
