#include <foam/search/refine.hpp>

#include "by_spheres/starts/starts.hpp"
#include "symmetric_difference.hpp"

#include <foam/base/random.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::fitted {
namespace {

using by_spheres::Ball;
using by_spheres::Balls;

/// Steps in units of the balls' mean radius, falling geometrically from first to last.
struct Steps {
    std::size_t count;
    float first, last;
};
constexpr Steps look{60, 0.08f, 0.01f}, settle{120, 0.04f, 0.001f};

/// Number of the solid's cells that suffices to find clusters.
constexpr std::size_t some_points = 1500;

/// Descends along the shape derivative, in steps of even length by adaptive moments (Kingma and Ba 2015, "Adam"). At
/// the optimum half of every ball's exposed surface lies inside the solid.
Balls descend(const SymmetricDifference& difference, Balls balls, const Steps& steps) {
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
        difference.slopes(balls, step, slopes);
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

/// Balls and their symmetric difference.
struct Candidate {
    Balls balls;
    double cost = 0;
};

class Search {
public:
    explicit Search(const SymmetricDifference& difference) : difference_(difference) {}

    Candidate candidate(Balls balls) const {
        const double cost = difference_.of(balls);
        return {std::move(balls), cost};
    }

    /// Returns the best of the start, balls packed into the solid and a few clusterings of it, each after a short
    /// descent.
    Candidate best_start(const Balls& start, std::size_t most) const {
        Random random(1);
        std::vector<Balls> starts{start, difference_.filled({}, most)};
        constexpr int clusterings = 3;
        const by_spheres::Points inside = difference_.some_inside(std::max(some_points, 4 * most));
        for (int i = 0; i < clusterings && inside.size() > most; ++i) {
            starts.push_back(by_spheres::clusters(inside, most, random));
            for (Ball& ball : starts.back()) {
                ball.r *= 0.75f; // they contain their clusters: this is about the volume of the clusters
            }
        }
        Candidate best;
        best.cost = std::numeric_limits<double>::infinity();
        for (Balls& balls : starts) {
            if (balls.empty()) {
                continue;
            }
            Candidate other = candidate(descend(difference_, std::move(balls), look));
            if (other.cost < best.cost) {
                best = std::move(other);
            }
        }
        return best;
    }

    /// Returns the balls with the one that contributes least moved to where the missing volume is greatest.
    Balls moved(const Candidate& now) const {
        const std::vector<double> uses = difference_.uses(now.balls);
        Balls balls = now.balls;
        balls.erase(balls.begin() + (std::min_element(uses.begin(), uses.end()) - uses.begin()));
        return difference_.filled(std::move(balls), now.balls.size());
    }

    Candidate far(const Balls& start, std::size_t most) const {
        Candidate best = candidate(descend(difference_, best_start(start, most).balls, settle));
        constexpr int moves = 8;
        for (int i = 0; i < moves && best.balls.size() > 1; ++i) {
            Candidate other = candidate(descend(difference_, moved(best), settle));
            if (!(other.cost < best.cost)) {
                break;
            }
            best = std::move(other);
        }
        return best;
    }

private:
    const SymmetricDifference& difference_;
};

/// Returns the cells along the longest extent so that the box has about the same number of cells, whatever its shape.
/// It grows with the number of balls, as one of many balls is small.
int resolution(const Vec3& size, std::size_t count) {
    const double of_a_cube = 12 * std::cbrt(static_cast<double>(std::max<std::size_t>(count, 16)));
    const double longest = std::max({size.x, size.y, size.z}), volume = size.x * size.y * size.z;
    const double slenderness = volume > 0 ? longest / std::cbrt(volume) : 4;
    return static_cast<int>(std::min(of_a_cube, 64.0) * std::min(slenderness, 4.0));
}

} // namespace

std::vector<Sphere> fit(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach) {
    const by_spheres::Frame frame(solid.bounds());
    const SymmetricDifference difference(
        solid, frame, resolution(solid.bounds().size(), reach == Reach::far ? most : start.size()), 96);
    Balls balls = by_spheres::unit_balls(start, frame);
    if (!(difference.volume() > 0) || balls.empty()) {
        return {start.begin(), start.end()};
    }
    const Search search(difference);
    const Candidate before = search.candidate(balls);
    const Candidate after =
        reach == Reach::far ? search.far(balls, most) : search.candidate(descend(difference, std::move(balls), settle));
    if (!(after.cost < before.cost)) {
        return {start.begin(), start.end()};
    }
    std::vector<Sphere> result;
    for (const Ball& ball : after.balls) {
        result.push_back({frame.from_unit({ball.x, ball.y, ball.z}), ball.r * frame.unit});
    }
    return result;
}

} // namespace foam::search::fitted
