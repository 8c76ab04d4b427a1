#include "by_spheres/starts/starts.hpp"

#include "by_spheres/starts/power_cells.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace foam::inline search::by_spheres {
namespace {

/// Returns the volume of the union of two balls: their volumes minus the two caps of their intersection (units³).
double union_of_two(const Ball& a, const Ball& b) {
    constexpr double third = std::numbers::pi / 3;
    const double apart = std::sqrt(squared_distance(a, b)), ra = a.r, rb = b.r;
    const double whole = 4 * third * (ra * ra * ra + rb * rb * rb);
    if (apart >= ra + rb) {
        return whole;
    }
    if (apart <= std::abs(ra - rb)) {
        return 4 * third * std::pow(std::max(ra, rb), 3);
    }
    const double along = (apart * apart + ra * ra - rb * rb) / (2 * apart);
    const auto cap = [&](double radius, double height) { return third * height * height * (3 * radius - height); };
    return whole - cap(ra, ra - along) - cap(rb, rb - (apart - along));
}

struct Split {
    double saved = -std::numeric_limits<double>::infinity(); ///< units³
    Ball first, second;
};

class PlaneSplits {
public:
    explicit PlaneSplits(const Limits& limits) : enclosing_ball_(limits) {}

    /// Returns the best split of a ball by one of a few planes across the points' principal axes; it saves nothing if
    /// there are too few points.
    Split best(const Ball& ball, const Points& points) {
        Split best;
        height_.resize(points.size());
        for (const Vec3& axis : axes_of(points)) {
            const Ball normal = ball_of({axis, 0});
            float low = std::numeric_limits<float>::infinity(), high = -low;
            for (std::size_t p = 0; p < points.size(); ++p) {
                height_[p] = normal.x * points.x[p] + normal.y * points.y[p] + normal.z * points.z[p];
                low = std::min(low, height_[p]);
                high = std::max(high, height_[p]);
            }
            for (int k = 1; k <= offsets; ++k) {
                try_plane(ball, points, low + (high - low) * static_cast<float>(k) / (offsets + 1), best);
            }
        }
        return best;
    }

private:
    static constexpr int offsets = 3;

    void try_plane(const Ball& ball, const Points& points, float offset, Split& best) {
        for (Points& half : halves_) {
            half.clear();
        }
        for (std::size_t p = 0; p < points.size(); ++p) {
            halves_[height_[p] < offset].add(points, p);
        }
        if (halves_[0].size() == 0 || halves_[1].size() == 0) {
            return;
        }
        const Vec3 near{ball.x, ball.y, ball.z};
        const Ball first = enclosing_ball_.of(halves_[0], halves_[0].size(), {}, near);
        const Ball second = enclosing_ball_.of(halves_[1], halves_[1].size(), {}, near);
        const double saved = 4 * std::numbers::pi / 3 * std::pow(ball.r, 3) - union_of_two(first, second);
        if (saved > best.saved) {
            best = {saved, first, second};
        }
    }

    std::vector<float> height_;
    std::array<Points, 2> halves_;
    LimitedBall enclosing_ball_;
};

/// Returns the points that a ball owns.
Points owned_by(std::size_t ball, const Points& points, const Owners& owners) {
    Points owned;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (owners.owner[p] == ball) {
            owned.add(points, p);
        }
    }
    return owned;
}

} // namespace

Balls divided(const Points& points, Balls balls, std::size_t count, const Limits& limits) {
    if (balls.empty()) {
        balls.push_back(LimitedBall(limits).of(points, points.size(), {}, {}));
    }
    PlaneSplits splits(limits);
    Owners owners;
    std::vector<Split> best(balls.size());
    const auto look = [&](std::size_t i) { best[i] = splits.best(balls[i], owned_by(i, points, owners)); };
    owners.find(points, balls);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        look(i);
    }
    while (balls.size() < count) {
        check_cancelled();
        const auto most = std::max_element(best.begin(), best.end(),
                                           [](const Split& a, const Split& b) { return a.saved < b.saved; });
        if (!std::isfinite(most->saved)) {
            break;
        }
        const auto i = static_cast<std::size_t>(most - best.begin());
        balls[i] = most->first;
        balls.push_back(most->second);
        best.emplace_back();
        // A split hardly changes the gain of other splits.
        owners.update(points, balls, i, balls.size() - 1);
        look(i);
        look(balls.size() - 1);
    }
    return balls;
}

} // namespace foam::search::by_spheres
