#include "uncovered.hpp"

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

double farthest(const Vec3& center, const Corners& t) {
    return std::sqrt(std::max(
        {squared_norm(t[0] - center), squared_norm(t[1] - center), squared_norm(t[2] - center)}));
}

} // namespace

/// For one ball.
class Uncovered::Search {
public:
    Search(std::span<const Sphere> balls, std::size_t index, double shift, double resolution) :
        balls_(balls), own_(balls[index]), index_(index), slack_(2 * shift), resolution_(resolution) {}

    /// A first lower bound of the ball's reach: corners that no other ball holds or is nearer to.
    void bound_by_corners(const Corners& t) {
        for (const Vec3& p : t) {
            const double from_center = distance(p, own_.center);
            if (from_center > reach_ && least_gap_of_others(p) > std::max(0.0, from_center - own_.radius)) {
                reach_ = from_center;
            }
        }
    }

    /// Collects what is needed of a triangle.
    void take(const Corners& triangle) {
        pieces_.assign(1, triangle);
        while (!pieces_.empty()) {
            const Corners t = pieces_.back();
            pieces_.pop_back();
            const double far = farthest(own_.center, t);
            if (far < reach_ - slack_ || holder(t) != nobody) {
                continue;
            }
            const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
            const double size = farthest(middle, t), gap = least_gap_of_others(middle);
            if (gap < distance(middle, own_.center) - own_.radius - 2 * size) {
                continue;   // another ball is nearer to all of the piece
            }
            if (gap > size) {   // no other ball reaches the piece
                add(t, far);
            } else if (!split(t) && !others_duty(t, far)) {
                add(t, far);
            }
        }
    }

    /// The other ball that holds the whole piece.
    std::uint32_t holder(const Corners& t) const {
        for (std::size_t j = 0; j < balls_.size(); ++j) {
            if (j != index_ && holds(balls_[j], t)) {
                return static_cast<std::uint32_t>(j);
            }
        }
        return nobody;
    }

    std::vector<Vec3> result() && {
        std::erase_if(points_, [&](const Vec3& p) { return distance(p, own_.center) < reach_ - slack_; });
        return std::move(points_);
    }

private:
    /// Negative inside.
    double least_gap_of_others(const Vec3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < balls_.size(); ++j) {
            const double bar = least + balls_[j].radius;
            if (j != index_ && bar > 0) {
                const double square = squared_norm(p - balls_[j].center);
                if (square < bar * bar) {
                    least = std::sqrt(square) - balls_[j].radius;
                }
            }
        }
        return least;
    }

    bool split(const Corners& t) {
        const std::array<double, 3> edges{squared_norm(t[1] - t[0]), squared_norm(t[2] - t[1]), squared_norm(t[0] - t[2])};
        const auto k = static_cast<std::size_t>(std::max_element(edges.begin(), edges.end()) - edges.begin());
        if (edges[k] <= resolution_ * resolution_) {
            return false;
        }
        const Vec3 &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3], middle = (a + b) * 0.5;
        pieces_.push_back({a, middle, c});
        pieces_.push_back({middle, b, c});
        return true;
    }

    bool others_duty(const Corners& t, double far) const {
        const double own_growth = far - own_.radius;
        for (std::size_t j = 0; j < balls_.size(); ++j) {
            if (j != index_ && farthest(balls_[j].center, t) - balls_[j].radius < own_growth) {
                return true;
            }
        }
        return false;
    }

    void add(const Corners& t, double far) {
        points_.insert(points_.end(), t.begin(), t.end());
        reach_ = std::max(reach_, far);
    }

    std::span<const Sphere> balls_;
    Sphere own_;
    std::size_t index_;
    double slack_, resolution_;
    double reach_ = 0;   ///< of what is known to be needed
    std::vector<Corners> pieces_;
    std::vector<Vec3> points_;
};

std::vector<Vec3> Uncovered::needed(std::span<const Sphere> balls, std::size_t index, double shift) {
    Search search(balls, index, shift, resolution_);
    std::vector<std::size_t> open;
    for (std::size_t s = 0; s < surface_.size(); ++s) {
        const std::uint32_t last = holder_[s];
        if (last == index || last >= balls.size() || !holds(balls[last], surface_[s])) {
            holder_[s] = search.holder(surface_[s]);
            if (holder_[s] == nobody) {
                open.push_back(s);
                search.bound_by_corners(surface_[s]);
            }
        }
    }
    for (const std::size_t s : open) {
        search.take(surface_[s]);
    }
    return std::move(search).result();
}

} // namespace foam::medial
