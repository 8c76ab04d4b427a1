#include "by_spheres/measured/occupancy.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/spherize.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

namespace foam::inline search::by_spheres {
namespace {

/// Searches for at most `count` balls in the solid whose union has the greatest volume. Centres are chosen greedily
/// among the cells of a lattice, each ball as large as the solid allows, always the one that adds most (within 1 - 1/e
/// of the best choice of these: Nemhauser et al. 1978). Then each ball moves to where it adds more (pattern search,
/// Hooke and Jeeves 1961), and the ball that adds least is moved elsewhere as long as that helps. Radii are distances
/// to the surface; nothing is proved. Deterministic, on one thread.
class InnerSearch {
public:
    /// `count`: wanted number of balls; more balls get a finer lattice.
    InnerSearch(const Solid& solid, std::size_t count, std::function<bool()> stop);

    /// Returns the balls, continuing from `start`, which has fewer than wanted. The result has fewer if no cell
    /// remains, none if no ball fits.
    std::vector<Sphere> balls(std::span<const Sphere> start) const;

private:
    /// For each cell, the number of balls that contain it.
    using Holders = std::vector<std::uint32_t>;

    Ball ball_about(float x, float y, float z) const;
    /// Returns the slices along z that the ball reaches, as a range of cells.
    std::pair<std::size_t, std::size_t> slices(const Ball& ball) const;
    template <class Body> void for_cells_in(const Ball& ball, Body&& body) const;
    void count_in(const Ball& ball, int change, Holders& holders) const;
    /// Returns the number of cells that only this ball contains.
    std::size_t gain(const Ball& ball, const Holders& holders) const;
    std::size_t held(const Holders& holders) const;
    void fill(Balls& balls, Holders& holders) const;
    void improve(Balls& balls, Holders& holders) const;
    Ball moved(Ball ball, const Holders& others) const;

    const Solid& solid_;
    std::size_t count_;
    std::function<bool()> stop_;
    Frame frame_;
    Occupancy occupancy_;
    std::vector<std::uint32_t> candidates_; ///< cells, the deepest first
};

constexpr std::size_t most_candidates = 3000;

/// Returns the cells along the longest extent so that the solid's box has about the same number of cells, whatever its
/// shape.
int resolution(const Vec3& size, std::size_t count) {
    const double of_a_cube = std::min(12 * std::cbrt(static_cast<double>(std::max<std::size_t>(count, 8))), 48.0);
    const double longest = std::max({size.x, size.y, size.z}), volume = size.x * size.y * size.z;
    const double slenderness = volume > 0 ? std::min(longest / std::cbrt(volume), 4.0) : 4;
    return static_cast<int>(of_a_cube * slenderness);
}

InnerSearch::InnerSearch(const Solid& solid, std::size_t count, std::function<bool()> stop)
    : solid_(solid), count_(count), stop_(std::move(stop)), frame_(solid.bounds()),
      occupancy_(solid, frame_, resolution(solid.bounds().size(), count)) {
    candidates_.resize(occupancy_.inside().size());
    std::iota(candidates_.begin(), candidates_.end(), 0u);
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return occupancy_.depth()[a] > occupancy_.depth()[b]; });
    const std::size_t all = candidates_.size(), kept = std::min(all, most_candidates);
    for (std::size_t i = 0; i < kept; ++i) {
        candidates_[i] = candidates_[i * all / kept];
    }
    candidates_.resize(kept);
}

Ball InnerSearch::ball_about(float x, float y, float z) const {
    const double depth = -solid_.signed_distance(frame_.from_unit({x, y, z})) / frame_.unit;
    return {x, y, z, static_cast<float>(depth)};
}

std::pair<std::size_t, std::size_t> InnerSearch::slices(const Ball& ball) const {
    const std::vector<float>& z = occupancy_.inside().z; // ascending
    const auto from = std::lower_bound(z.begin(), z.end(), ball.z - ball.r);
    const auto to = std::upper_bound(from, z.end(), ball.z + std::max(ball.r, 0.0f));
    return {static_cast<std::size_t>(from - z.begin()), static_cast<std::size_t>(to - z.begin())};
}

template <class Body> void InnerSearch::for_cells_in(const Ball& ball, Body&& body) const {
    const Points& cells = occupancy_.inside();
    const auto [first, last] = slices(ball);
    for (std::size_t p = first; p < last; ++p) {
        if (ball.squared_distance(cells.x[p], cells.y[p], cells.z[p]) <= ball.r * ball.r) {
            body(p);
        }
    }
}

void InnerSearch::count_in(const Ball& ball, int change, Holders& holders) const {
    for_cells_in(ball, [&](std::size_t p) { holders[p] += static_cast<std::uint32_t>(change); });
}

std::size_t InnerSearch::gain(const Ball& ball, const Holders& holders) const {
    const float *x = occupancy_.inside().x.data(), *y = occupancy_.inside().y.data(), *z = occupancy_.inside().z.data();
    const auto [first, last] = slices(ball);
    std::uint32_t count = 0;
    for (std::size_t p = first; p < last; ++p) { // without branches, for vectorisation
        const std::uint32_t within = ball.squared_distance(x[p], y[p], z[p]) <= ball.r * ball.r ? 1 : 0;
        count += within & (holders[p] == 0 ? 1u : 0u);
    }
    return count;
}

std::size_t InnerSearch::held(const Holders& holders) const {
    return holders.size() - static_cast<std::size_t>(std::count(holders.begin(), holders.end(), 0));
}

/// Adds balls greedily, with lazy evaluation (Minoux 1978): the gain of a ball only falls as others are added, so most
/// need no second evaluation.
void InnerSearch::fill(Balls& balls, Holders& holders) const {
    struct Bound {
        std::size_t gain, candidate;
        bool operator<(const Bound& other) const {
            return gain != other.gain ? gain < other.gain : candidate > other.candidate;
        }
    };
    const Points& cells = occupancy_.inside();
    std::vector<Ball> about;
    std::vector<Bound> heap;
    const float cell = occupancy_.cell();
    for (const std::uint32_t p : candidates_) {
        about.push_back({cells.x[p], cells.y[p], cells.z[p], occupancy_.depth()[p]});
        const double cells_across = about.back().r / cell + 1;
        heap.push_back({static_cast<std::size_t>(4.2 * cells_across * cells_across * cells_across), heap.size()});
    }
    std::make_heap(heap.begin(), heap.end());
    while (balls.size() < count_ && !heap.empty() && !stop_()) {
        check_cancelled();
        std::pop_heap(heap.begin(), heap.end());
        Bound& last = heap.back();
        last.gain = gain(about[last.candidate], holders);
        if (heap.size() > 1 && last < heap.front()) {
            std::push_heap(heap.begin(), heap.end());
            continue;
        }
        const Ball ball = moved(about[last.candidate], holders);
        heap.pop_back();
        if (gain(ball, holders) == 0) {
            break;
        }
        balls.push_back(ball);
        count_in(ball, 1, holders);
    }
}

Ball InnerSearch::moved(Ball ball, const Holders& others) const {
    // A small reward for size, so that balls grow where the number of cells is equal.
    const auto worth = [&](const Ball& b) {
        const double across = b.r / occupancy_.cell();
        return b.r > 0 ? static_cast<double>(gain(b, others)) + 0.1 * across * across * across : 0;
    };
    ball = ball_about(ball.x, ball.y, ball.z);
    double best = worth(ball);
    for (float step = ball.r / 2; step > ball.r / 20 && step > 0;) {
        const Ball from = ball;
        for (int side = 0; side < 6; ++side) {
            const float d = side % 2 ? step : -step;
            const Ball next = ball_about(from.x + (side / 2 == 0 ? d : 0), from.y + (side / 2 == 1 ? d : 0),
                                         from.z + (side / 2 == 2 ? d : 0));
            if (const double now = worth(next); now > best) {
                best = now;
                ball = next;
            }
        }
        step = ball == from ? step / 2 : step;
    }
    return ball;
}

void InnerSearch::improve(Balls& balls, Holders& holders) const {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds && !stop_(); ++round) {
        check_cancelled();
        bool any = false;
        for (Ball& ball : balls) {
            count_in(ball, -1, holders);
            const Ball next = moved(ball, holders);
            any |= !(next == ball);
            ball = next;
            count_in(ball, 1, holders);
        }
        if (!any) {
            return;
        }
    }
}

std::vector<Sphere> InnerSearch::balls(std::span<const Sphere> start) const {
    Balls best;
    Holders holders(occupancy_.inside().size(), 0);
    for (const Sphere& sphere : start) {
        best.push_back(unit_ball(sphere, frame_));
        count_in(best.back(), 1, holders);
    }
    fill(best, holders);
    improve(best, holders);
    const std::size_t trials = std::min<std::size_t>(best.size(), 4);
    for (std::size_t i = 0; i < trials && best.size() > 1 && !stop_(); ++i) {
        std::vector<std::size_t> alone(best.size());
        for (std::size_t k = 0; k < best.size(); ++k) {
            for_cells_in(best[k], [&](std::size_t p) { alone[k] += holders[p] == 1; });
        }
        Balls other = best;
        const auto least = std::min_element(alone.begin(), alone.end()) - alone.begin();
        Holders others = holders;
        count_in(best[static_cast<std::size_t>(least)], -1, others);
        other.erase(other.begin() + least);
        fill(other, others);
        improve(other, others);
        if (held(others) <= held(holders)) {
            break;
        }
        best = std::move(other);
        holders = std::move(others);
    }
    std::vector<Sphere> spheres;
    for (const Ball& ball : best) {
        spheres.push_back({frame_.from_unit({ball.x, ball.y, ball.z}), ball.r * frame_.unit});
    }
    return spheres;
}

} // namespace
} // namespace foam::inline search::by_spheres

namespace foam::inline search {

std::vector<Sphere> spheres_inside(const Solid& solid, std::size_t count, const std::function<bool()>& stop) {
    const std::function<bool()> asked = stop ? stop : [] { return false; };
    const by_spheres::InnerSearch search(solid, count, asked);
    std::vector<Sphere> best;
    const auto take = [&](std::vector<Sphere> spheres) {
        spheres = shrunk_to_fit(solid, std::move(spheres));
        std::erase_if(spheres, [](const Sphere& sphere) { return !(sphere.radius > 0); });
        if (exact_union_volume(spheres) > exact_union_volume(best)) {
            best = std::move(spheres);
        }
    };
    if (count > 1) {
        const std::vector<Sphere> fewer = spheres_inside(solid, std::bit_ceil(count) / 2, stop);
        take(fewer);
        take(search.balls(fewer));
    }
    if (count == 1 || !asked()) {
        take(search.balls({}));
    }
    return best;
}

} // namespace foam::inline search
