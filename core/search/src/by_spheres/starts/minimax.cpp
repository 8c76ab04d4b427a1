#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>

namespace foam::inline search::by_spheres {
namespace {

Minimax rated(Balls balls, const BallCost& cost) {
    Minimax result{std::move(balls), {}, 0};
    for (const Ball& ball : result.balls) {
        result.costs.push_back(cost.of(ball));
    }
    result.worst = *std::max_element(result.costs.begin(), result.costs.end());
    return result;
}

/// Returns the balls that own a part of the surface, in order.
Balls owners_of(const Balls& balls, const Owners& owners) {
    std::vector<char> owns(balls.size(), 0);
    for (const std::uint32_t owner : owners.owner) {
        owns[owner] = 1;
    }
    Balls result;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (owns[i]) {
            result.push_back(balls[i]);
        }
    }
    return result;
}

} // namespace

std::size_t Minimax::dearest() const {
    return static_cast<std::size_t>(std::max_element(costs.begin(), costs.end()) - costs.begin());
}

Minimax MinimaxSearch::fitted(const Balls& balls) {
    Balls enclosing = cells_.fitted(balls, {});
    const Balls before = owners_of(balls, cells_.owners());
    for (std::size_t i = 0; i < enclosing.size(); ++i) {
        enclosing[i] = cost_.holding(cells_.parts()[i], enclosing[i], before[i]);
    }
    return rated(std::move(enclosing), cost_);
}

Balls MinimaxSearch::grown(const Minimax& cover) const {
    Balls balls = cover.balls;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        balls[i].r += static_cast<float>(cover.worst - cover.costs[i]);
    }
    return balls;
}

Balls MinimaxSearch::with_split(const Minimax& cover) {
    const Balls balls = grown(cover);
    cells_.fitted(balls, {});
    const Balls owners = owners_of(balls, cells_.owners());
    const Ball dearest = cover.balls[cover.dearest()]; // it has not grown
    Balls result = balls;
    for (std::size_t k = 0; k < owners.size(); ++k) {
        if (owners[k] == dearest) {
            const Balls two = divided(cells_.parts()[k], {}, 2);
            result[cover.dearest()] = two.front();
            result.push_back(two.back());
            break;
        }
    }
    return result;
}

Minimax MinimaxSearch::improved(const Balls& start, std::size_t count, int rounds) {
    constexpr double least_gain = 1e-4;
    constexpr int most_idle = 4;
    Minimax best = fitted(start), now = best;
    for (int round = 0, idle = 0; round < rounds && idle < most_idle; ++round) {
        check_cancelled();
        now = fitted(now.balls.size() < count ? with_split(now) : grown(now));
        idle = now.worst < best.worst * (1 - least_gain) ? 0 : idle + 1;
        if (now.worst < best.worst) {
            best = now;
        }
    }
    return best;
}

Minimax MinimaxSearch::moved(const Minimax& cover, std::size_t i, int rounds) {
    Balls balls = with_split(cover);
    balls.erase(balls.begin() + static_cast<std::ptrdiff_t>(i));
    return improved(balls, cover.balls.size(), rounds);
}

Minimax MinimaxSearch::leaner(const Minimax& cover, const Points& directions, int rounds) {
    Minimax best = cover;
    double least = exact_union_volume(unit_spheres(cover.balls));
    for (int round = 0; round < rounds; ++round) {
        check_cancelled();
        Balls balls = cells_.fitted(best.balls, directions);
        const Balls before = owners_of(best.balls, cells_.owners());
        for (std::size_t i = 0; i < balls.size(); ++i) {
            if (cost_.of(balls[i]) > cover.worst) {
                const Points& part = cells_.parts()[i];
                const Ball enclosing =
                    EnclosingBall().of(part, part.size(), {}, {before[i].x, before[i].y, before[i].z});
                balls[i] = cost_.holding(part, enclosing, before[i]);
            }
        }
        const double volume = exact_union_volume(unit_spheres(balls));
        Minimax next = rated(std::move(balls), cost_);
        if (!(volume < least) || next.worst > cover.worst) {
            break;
        }
        least = volume;
        best = std::move(next);
    }
    return best;
}

} // namespace foam::search::by_spheres
