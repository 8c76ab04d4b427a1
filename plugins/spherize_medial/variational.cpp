#include "optimise.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <array>
#include <numbers>

namespace foam::medial {
namespace {

/// The gradient of one ball: by x, y, z of the centre and by the radius.
using Slope = std::array<double, 4>;

/// Steps of constant size where the sign of the gradient is constant, small where it changes (Kingma and Ba 2015,
/// "Adam").
class AdaptiveMoments {
public:
    explicit AdaptiveMoments(std::size_t count) : mean_(count), square_(count) {}

    void step(std::vector<Sphere>& balls, const std::vector<Slope>& slopes, double length) {
        constexpr double mean_decay = 0.8, square_decay = 0.95;
        mean_scale_ *= mean_decay;
        square_scale_ *= square_decay;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            Slope move{};
            double square = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                mean_[i][k] = mean_decay * mean_[i][k] + (1 - mean_decay) * slopes[i][k];
                square += slopes[i][k] * slopes[i][k] / 4;
            }
            // One scale for the four components keeps a ball's direction of steepest descent.
            square_[i] = square_decay * square_[i] + (1 - square_decay) * square;
            const double rms = std::sqrt(square_[i] / (1 - square_scale_));
            for (std::size_t k = 0; k < 4; ++k) {
                move[k] = rms > 0 ? -length * mean_[i][k] / (1 - mean_scale_) / rms : 0;
            }
            balls[i].center += Vec3{move[0], move[1], move[2]};
            balls[i].radius = std::max(balls[i].radius + move[3], 1e-6);
        }
    }

private:
    std::vector<Slope> mean_;
    std::vector<double> square_;
    double mean_scale_ = 1, square_scale_ = 1;
};

class Descent {
public:
    Descent(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns, std::size_t directions)
        : points_(points), balls_(std::move(balls)), columns_(columns), directions_(fibonacci_directions(directions)),
          owner_(points.size(), 0), slopes_(balls_.size()), moments_(balls_.size()) {}

    std::vector<Sphere> run(int steps, Context& context) {
        double mean_radius = 0;
        for (const Sphere& ball : balls_) {
            mean_radius += ball.radius / static_cast<double>(balls_.size());
        }
        constexpr double first = 0.06, last = 0.002; // step lengths in units of the balls' mean radius
        for (int i = 0; i < steps; ++i) {
            context.check_cancelled();
            slopes_.assign(balls_.size(), Slope{});
            add_exposed_areas();
            add_penalties();
            const double length = first * std::pow(last / first, i / (steps - 1.0));
            moments_.step(balls_, slopes_, length * mean_radius);
        }
        return balls_;
    }

private:
    /// Adds the exposed areas. ∂ vol(U \ S) / ∂ r_i is the area of sphere i outside the other balls and the solid; the
    /// derivative by the centre is the integral of the normal over that area.
    void add_exposed_areas() {
        std::vector<std::size_t> near;
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const Sphere& ball = balls_[i];
            near.clear();
            for (std::size_t j = 0; j < balls_.size(); ++j) {
                const double sum = ball.radius + balls_[j].radius;
                if (j != i && squared_norm(ball.center - balls_[j].center) < sum * sum) {
                    near.push_back(j);
                }
            }
            const double area =
                4 * std::numbers::pi * ball.radius * ball.radius / static_cast<double>(directions_.size());
            for (const Vec3& direction : directions_) {
                const Vec3 place = ball.center + direction * ball.radius;
                const bool hidden = std::any_of(near.begin(), near.end(), [&](std::size_t j) {
                    return squared_norm(place - balls_[j].center) < balls_[j].radius * balls_[j].radius;
                });
                if (!hidden && !columns_.inside(place)) {
                    for (int k = 0; k < 3; ++k) {
                        slopes_[i][static_cast<std::size_t>(k)] += area * direction[k];
                    }
                    slopes_[i][3] += area;
                }
            }
        }
    }

    /// Adds an exact penalty: a point outside all balls pulls the nearest one with a force above the largest opposite
    /// force of exposed area, so that the optimum contains the points, not only nearly.
    void add_penalties() {
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const Vec3& point = points_[p];
            const Sphere& last = balls_[owner_[p]];
            if (squared_norm(point - last.center) <= last.radius * last.radius) {
                continue;
            }
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < balls_.size(); ++i) {
                const double gap = distance(point, balls_[i].center) - balls_[i].radius;
                if (gap < least) {
                    least = gap;
                    owner_[p] = static_cast<std::uint32_t>(i);
                }
            }
            if (least <= 0) {
                continue;
            }
            const Sphere& ball = balls_[owner_[p]];
            const Vec3 outward = normalized(point - ball.center);
            const double area = 4 * std::numbers::pi * ball.radius * ball.radius;
            const double force = area * (0.15 + 10 * least / std::max(ball.radius, 1e-6));
            Slope& slope = slopes_[owner_[p]];
            for (int k = 0; k < 3; ++k) {
                slope[static_cast<std::size_t>(k)] -= force * outward[k];
            }
            slope[3] -= force;
        }
    }

    std::span<const Vec3> points_;
    std::vector<Sphere> balls_;
    const Columns& columns_;
    std::vector<Vec3> directions_;
    std::vector<std::uint32_t> owner_;
    std::vector<Slope> slopes_;
    AdaptiveMoments moments_;
};

/// Sets radii so that the balls contain the points with the present centres: each contains the points that it is
/// nearest to.
void close(std::span<const Vec3> points, std::vector<Sphere>& balls) {
    const auto owner = assign(points, balls);
    std::vector<double> radius(balls.size(), 0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        radius[owner[p]] = std::max(radius[owner[p]], distance(points[p], balls[owner[p]].center));
    }
    for (std::size_t i = 0; i < balls.size(); ++i) {
        balls[i].radius = radius[i];
    }
}

} // namespace

std::vector<Sphere> variational(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns,
                                const DescentOptions& options, Context& context) {
    balls = Descent(points, std::move(balls), columns, options.directions).run(options.steps, context);
    close(points, balls);
    return balls;
}

} // namespace foam::medial
