#include <foam/search/refine.hpp>

#include "by_spheres/starts/starts.hpp"
#include "target.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace foam::inline search::fitted {
namespace {

using by_spheres::Ball;
using by_spheres::Balls;

/// Steps in units of the balls' mean radius, falling geometrically from first to last.
struct Steps {
    std::size_t count;
    float first, last;
};
constexpr Steps look{60, 0.08f, 0.01f}, settle{160, 0.04f, 0.001f};

/// Number of the solid's cells that suffices to find clusters.
constexpr std::size_t some_points = 1500;

/// Descends along the derivative, in steps of even length by adaptive moments (Kingma and Ba 2015, "Adam").
Balls descend(const Target& target, Balls balls, const Steps& steps) {
    constexpr float mean_decay = 0.8f, square_decay = 0.95f;
    float size = 0;
    for (const Ball& ball : balls) {
        size += ball.r / static_cast<float>(balls.size());
    }
    std::vector<by_spheres::Slope> slopes, mean(balls.size());
    std::vector<float> square(balls.size(), 0);
    float mean_scale = 1, square_scale = 1, length = steps.first * size;
    const float ratio = std::pow(steps.last / steps.first, 1 / static_cast<float>(steps.count - 1));
    for (std::size_t step = 0; step < steps.count; ++step, length *= ratio) {
        target.slopes(balls, step, slopes);
        mean_scale *= mean_decay;
        square_scale *= square_decay;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const auto blend = [&](float& m, float s) { m = mean_decay * m + (1 - mean_decay) * s; };
            const by_spheres::Slope& s = slopes[i];
            blend(mean[i].x, s.x);
            blend(mean[i].y, s.y);
            blend(mean[i].z, s.z);
            blend(mean[i].r, s.r);
            // One scale for all four: a ball keeps its direction of steepest descent.
            square[i] =
                square_decay * square[i] + (1 - square_decay) * (s.x * s.x + s.y * s.y + s.z * s.z + s.r * s.r) / 4;
            const float rms = std::sqrt(square[i] / (1 - square_scale));
            const float scale = rms > 0 ? -length / (1 - mean_scale) / rms : 0;
            balls[i].x += scale * mean[i].x;
            balls[i].y += scale * mean[i].y;
            balls[i].z += scale * mean[i].z;
            balls[i].r = std::max(balls[i].r + scale * mean[i].r, 1e-6f);
        }
    }
    return balls;
}

/// Balls and what the fit makes least for them.
struct Candidate {
    Balls balls;
    double cost = std::numeric_limits<double>::infinity();
};

/// How much is tried. Few balls are quick to fit, and one in a wrong place is worse.
struct Patience {
    int clusterings;
    std::size_t settled; ///< of the starts, the best
    int moves;
    std::size_t movable; ///< balls that are moved, those that contribute least
};
constexpr Patience few_balls{10, 3, 12, 2}, many_balls{4, 2, 12, 2};
constexpr std::size_t few = 16;

class Search {
public:
    Search(const Target& target, std::size_t most)
        : target_(target), most_(most), patience_(most <= few ? few_balls : many_balls) {}

    Candidate candidate(Balls balls) const {
        const double cost = target_.of(balls);
        return {std::move(balls), cost};
    }

    Candidate far(const Balls& start) const {
        std::vector<Candidate> starts = descended(all_starts(start), look);
        const auto less = [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; };
        std::stable_sort(starts.begin(), starts.end(), less);
        std::vector<Balls> best_starts;
        for (std::size_t i = 0; i < std::min(starts.size(), patience_.settled); ++i) {
            best_starts.push_back(std::move(starts[i].balls));
        }
        const std::vector<Candidate> settled = descended(best_starts, settle);
        return with_moves(*std::min_element(settled.begin(), settled.end(), less));
    }

private:
    std::vector<Candidate> descended(const std::vector<Balls>& starts, const Steps& steps) const {
        std::vector<Candidate> result(starts.size());
        parallel_for(starts.size(), [&](std::size_t i) { result[i] = candidate(descend(target_, starts[i], steps)); });
        return result;
    }

    /// Returns the start, balls packed into the solid, and clusterings of its inside and of its surface, of which a
    /// thin part has a larger share.
    std::vector<Balls> all_starts(const Balls& start) const {
        Random random(1);
        std::vector<Balls> starts{start};
        if (Balls packed = target_.difference().filled({}, most_); !packed.empty()) {
            starts.push_back(std::move(packed));
        }
        const by_spheres::Points inside = target_.difference().some_inside(std::max(some_points, 4 * most_));
        for (int i = 0; i < patience_.clusterings; ++i) {
            const by_spheres::Points& points = i % 2 == 0 ? inside : target_.distance().some_points();
            if (points.size() <= most_) {
                continue;
            }
            starts.push_back(by_spheres::clusters(points, most_, random));
            for (Ball& ball : starts.back()) {
                ball.r *= 0.75f; // they contain their clusters: this is about the volume of the clusters
            }
        }
        return starts;
    }

    /// Moves balls that contribute little, one at a time, while that improves the result.
    Candidate with_moves(Candidate best) const {
        std::vector<std::size_t> order = by_use(best.balls);
        std::size_t failed = 0; // each ball is tried at both places
        for (int i = 0; i < patience_.moves && best.balls.size() > 1; ++i) {
            if (failed >= 2 * std::min(patience_.movable, order.size())) {
                break;
            }
            Candidate other =
                candidate(descend(target_, moved(best.balls, order[failed / 2], failed % 2 == 1), settle));
            if (other.cost < best.cost) {
                best = std::move(other);
                order = by_use(best.balls);
                failed = 0;
            } else {
                ++failed;
            }
        }
        return best;
    }

    /// Returns the indices of the balls, that of least use first.
    std::vector<std::size_t> by_use(const Balls& balls) const {
        const std::vector<double> uses = target_.uses(balls);
        std::vector<std::size_t> order(balls.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return uses[a] < uses[b]; });
        return order;
    }

    /// Returns the balls with ball `i` moved into the largest pocket between the others, or to the point of the surface
    /// that is farthest from them.
    Balls moved(Balls balls, std::size_t i, bool to_the_farthest) const {
        const std::size_t count = balls.size();
        balls.erase(balls.begin() + static_cast<std::ptrdiff_t>(i));
        if (!to_the_farthest) {
            return target_.difference().filled(std::move(balls), count);
        }
        const SurfaceDistance::Farthest farthest = target_.distance().farthest(balls);
        if (farthest.distance > 0) {
            const Sphere sphere{farthest.place, farthest.distance / 2}; // it touches none of the others
            balls.push_back(by_spheres::ball_of(sphere));
        }
        return balls;
    }

    const Target& target_;
    const std::size_t most_;
    const Patience patience_;
};

std::vector<Sphere> fitted_to(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach,
                              const FitWeights& weights) {
    const by_spheres::Frame frame(solid.bounds());
    Balls balls = by_spheres::unit_balls(start, frame);
    const Target target(solid, frame, reach == Reach::far ? most : start.size(), weights, balls);
    if (!(target.difference().volume() > 0) || balls.empty()) {
        return {start.begin(), start.end()};
    }
    const Search search(target, most);
    const Candidate before = search.candidate(balls);
    const Candidate after =
        reach == Reach::far ? search.far(balls) : search.candidate(descend(target, std::move(balls), settle));
    if (!(after.cost < before.cost)) {
        return {start.begin(), start.end()};
    }
    std::vector<Sphere> result;
    for (const Ball& ball : after.balls) {
        result.push_back({frame.from_unit({ball.x, ball.y, ball.z}), ball.r * frame.unit});
    }
    return result;
}

} // namespace

std::vector<Sphere> fit(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach,
                        const FitWeights& weights, std::optional<double> max_gap) {
    std::vector<Sphere> spheres = fitted_to(solid, start, most, reach, weights);
    return max_gap && !spheres.empty() ? within_gap(solid, std::move(spheres), *max_gap) : spheres;
}

std::vector<Sphere> within_gap(const Solid& solid, std::vector<Sphere> spheres, double max_gap) {
    // Spheres with radii larger by a length cover the surface exactly if no point of it is farther than that from them.
    constexpr double for_rounding = 2e-3; // of the written numbers, and of the figure, an upper bound
    const double length = (1 - for_rounding) * max_gap;
    std::vector<Sphere> larger = spheres;
    for (Sphere& sphere : larger) {
        sphere.radius += length;
    }
    const std::vector<Sphere> grown = grown_to_cover(*as_surface(solid), larger);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (grown[i].radius > larger[i].radius) {
            spheres[i].radius = grown[i].radius - length;
        }
    }
    return spheres;
}

} // namespace foam::inline search::fitted
