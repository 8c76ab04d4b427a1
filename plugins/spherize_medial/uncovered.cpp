#include "optimise.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>

namespace foam::medial {
namespace {

constexpr std::uint32_t nobody = 0xFFFFFFFFu;

bool holds(const Sphere& ball, const Vec3& p) {
    return squared_norm(p - ball.center) <= ball.radius * ball.radius;
}

bool holds(const Sphere& ball, const Corners& t) {
    return holds(ball, t[0]) && holds(ball, t[1]) && holds(ball, t[2]);
}

double reach_of(const Vec3& center, const Corners& t) {
    return std::sqrt(std::max({squared_norm(t[0] - center), squared_norm(t[1] - center), squared_norm(t[2] - center)}));
}

/// Finds a ball other than `index` that contains all of the place; tries the last one first.
template <class Place>
std::uint32_t holder(std::span<const Sphere> balls, std::size_t index, const Place& place, std::uint32_t last) {
    if (last != index && last < balls.size() && holds(balls[last], place)) {
        return last;
    }
    for (std::size_t j = 0; j < balls.size(); ++j) {
        if (j != index && holds(balls[j], place)) {
            return static_cast<std::uint32_t>(j);
        }
    }
    return nobody;
}

/// Returns the distance to the nearest ball other than `index`; negative inside.
double gap_to_others(std::span<const Sphere> balls, std::size_t index, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < balls.size(); ++j) {
        const double bar = least + balls[j].radius;
        if (j != index && bar > 0) {
            const double square = squared_norm(p - balls[j].center);
            if (square < bar * bar) {
                least = std::sqrt(square) - balls[j].radius;
            }
        }
    }
    return least;
}

struct Candidate {
    double square; ///< of the distance to the centre
    Vec3 point;
};

/// Returns the candidates that can be the farthest from some centre within `shift` of the one their squares are from. k
/// replaces p where the plane between the two does not meet these centres: |k − o|² − |p − o|² ≥ 2 shift |k − p|.
std::vector<Vec3> decisive(std::vector<Candidate> candidates, double shift, double tolerance) {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.square != b.square     ? a.square > b.square
               : a.point.x != b.point.x ? a.point.x > b.point.x
               : a.point.y != b.point.y ? a.point.y > b.point.y
                                        : a.point.z > b.point.z;
    });
    std::vector<Candidate> kept;
    for (const Candidate& c : candidates) {
        const double allowance = 2 * tolerance * std::sqrt(c.square);
        const bool dominated = std::any_of(kept.begin(), kept.end(), [&](const Candidate& k) {
            const double lead = k.square - c.square + allowance;
            return lead * lead >= 4 * shift * shift * squared_norm(k.point - c.point);
        });
        if (!dominated) {
            kept.push_back(c);
        }
    }
    std::vector<Vec3> points;
    for (const Candidate& k : kept) {
        points.push_back(k.point);
    }
    return points;
}

/// Returns the corner k for which the edge to the next corner is the longest.
std::size_t longest_edge(const Corners& t) {
    const double a = squared_norm(t[1] - t[0]), b = squared_norm(t[2] - t[1]), c = squared_norm(t[0] - t[2]);
    return a >= b && a >= c ? 0 : b >= c ? 1 : 2;
}

/// The reach that one ball needs, computed triangle after triangle. Leaves out parts in another ball and parts within
/// the reach found already. Halves the rest until each piece is decided.
class Reach {
public:
    Reach(std::span<const Sphere> balls, std::size_t index, double resolution)
        : balls_(balls), own_(balls[index]), index_(index), resolution_(resolution) {}

    double value() const { return std::sqrt(square_); }
    /// Returns the point at that distance.
    const Vec3& place() const { return place_; }

    void take(const Corners& triangle) {
        pieces_.assign(1, triangle);
        CancellationCounter asking(256);
        while (!pieces_.empty()) {
            asking.check();
            const Corners t = pieces_.back();
            pieces_.pop_back();
            const double square = std::max(
                {squared_norm(t[0] - own_.center), squared_norm(t[1] - own_.center), squared_norm(t[2] - own_.center)});
            if (square <= std::max(square_, own_.radius * own_.radius) || holder(balls_, index_, t, 0) != nobody) {
                continue;
            }
            const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
            const double size = reach_of(middle, t), gap = gap_to_others(balls_, index_, middle);
            if (gap < distance(middle, own_.center) - own_.radius - 2 * size) {
                continue; // another ball is nearer to all of the piece
            }
            if (gap > size || (!halve(t) && !others_duty(t))) {
                square_ = square; // no other ball reaches the piece, or none needs less growth for it
                place_ = *std::max_element(t.begin(), t.end(), [&](const Vec3& a, const Vec3& b) {
                    return squared_norm(a - own_.center) < squared_norm(b - own_.center);
                });
            }
        }
    }

private:
    bool halve(const Corners& t) {
        const std::size_t k = longest_edge(t);
        const Vec3 &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3], middle = (a + b) * 0.5;
        if (squared_norm(b - a) <= resolution_ * resolution_) {
            return false;
        }
        // The farther half comes next: the sooner the reach is known, the fewer pieces remain.
        Corners first{a, middle, c}, second{middle, b, c};
        if (squared_norm(a - own_.center) > squared_norm(b - own_.center)) {
            std::swap(first, second);
        }
        pieces_.push_back(first);
        pieces_.push_back(second);
        return true;
    }

    bool others_duty(const Corners& t) const {
        const double own_growth = reach_of(own_.center, t) - own_.radius;
        for (std::size_t j = 0; j < balls_.size(); ++j) {
            if (j != index_ && reach_of(balls_[j].center, t) - balls_[j].radius < own_growth) {
                return true;
            }
        }
        return false;
    }

    std::span<const Sphere> balls_;
    Sphere own_;
    std::size_t index_;
    double resolution_, square_ = 0;
    Vec3 place_{};
    std::vector<Corners> pieces_;
};

} // namespace

std::vector<Vec3> Uncovered::needed(std::span<const Sphere> balls, std::size_t index, double shift, double tolerance) {
    const Sphere& own = balls[index];
    std::vector<Candidate> candidates;
    double reach = 0;
    CancellationCounter asking(1024);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        asking.check();
        point_holder_[p] = holder(balls, index, points_[p], point_holder_[p]);
        if (point_holder_[p] != nobody) {
            continue;
        }
        const double square = squared_norm(points_[p] - own.center), from_center = std::sqrt(square);
        if (from_center > own.radius && gap_to_others(balls, index, points_[p]) < from_center - own.radius) {
            continue;
        }
        if (from_center >= reach - 2 * shift) {
            reach = std::max(reach, from_center);
            candidates.push_back({square, points_[p]});
        }
    }
    return decisive(std::move(candidates), shift, tolerance);
}

std::optional<Vec3> Uncovered::missed(std::span<const Sphere> balls, std::size_t index, double resolution) {
    Reach reach(balls, index, resolution);
    std::vector<std::pair<double, std::size_t>> open;
    CancellationCounter asking(256);
    for (std::size_t s = 0; s < surface_.size(); ++s) {
        asking.check();
        triangle_holder_[s] = holder(balls, index, surface_[s], triangle_holder_[s]);
        if (triangle_holder_[s] == nobody) {
            open.emplace_back(-reach_of(balls[index].center, surface_[s]), s);
        }
    }
    std::sort(open.begin(), open.end());
    for (const auto& [ignored, s] : open) {
        reach.take(surface_[s]);
    }
    return reach.value() > balls[index].radius ? std::optional(reach.place()) : std::nullopt;
}

double Uncovered::add_missed(std::span<const Sphere> balls, double resolution) {
    double shortfall = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (const auto place = missed(balls, i, resolution)) {
            points_.push_back(*place);
            point_holder_.push_back(nobody);
            shortfall = std::max(shortfall, distance(*place, balls[i].center) / balls[i].radius - 1);
        }
    }
    return shortfall;
}

std::vector<Sphere> Uncovered::closed(std::vector<Sphere> balls, double resolution) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (const auto place = missed(balls, i, resolution)) {
            balls[i].radius = distance(*place, balls[i].center);
        }
    }
    return balls;
}

} // namespace foam::medial
