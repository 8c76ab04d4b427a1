#include "optimise.hpp"

#include <algorithm>
#include <queue>

namespace foam::medial {
namespace {

struct Cluster {
    std::vector<Vec3> points;
    Sphere ball;
    double cost = 0; ///< volume of the ball outside the solid
    bool alive = true;
};

struct Pair {
    double cost;
    std::uint32_t a, b;
    bool operator<(const Pair& other) const { // the least cost comes first out of a priority queue
        return cost != other.cost ? cost > other.cost : a != other.a ? a > other.a : b > other.b;
    }
};

class Merger {
public:
    Merger(std::span<const Vec3> points, std::span<const Sphere> balls, const Columns& columns) : columns_(columns) {
        for (auto& group : grouped(points, assign(points, balls), balls.size())) {
            if (!group.empty()) {
                add(std::move(group));
            }
        }
        for (std::uint32_t a = 0; a < clusters_.size(); ++a) {
            offer(a, a);
        }
    }

    std::size_t count() const { return count_; }

    std::vector<Sphere> balls() const {
        std::vector<Sphere> result;
        for (const Cluster& c : clusters_) {
            if (c.alive) {
                result.push_back(c.ball);
            }
        }
        return result;
    }

    void step() {
        while (!queue_.empty()) {
            const auto [cost, a, b] = queue_.top();
            queue_.pop();
            if (clusters_[a].alive && clusters_[b].alive) {
                unite(a, b);
                return;
            }
        }
        // If no neighbours are left, the nearest pair.
        std::uint32_t first = 0, second = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t a = 0; a < clusters_.size(); ++a) {
            for (std::uint32_t b = a + 1; b < clusters_.size(); ++b) {
                if (clusters_[a].alive && clusters_[b].alive) {
                    const double radius = enclosing_sphere(clusters_[a].ball, clusters_[b].ball).radius;
                    if (radius < least) {
                        least = radius;
                        first = a;
                        second = b;
                    }
                }
            }
        }
        unite(first, second);
    }

private:
    std::uint32_t add(std::vector<Vec3> points) {
        Cluster cluster{std::move(points), {}, 0, true};
        cluster.ball = minimum_enclosing_sphere(cluster.points);
        cluster.cost = columns_.outside(std::span(&cluster.ball, 1));
        clusters_.push_back(std::move(cluster));
        ++count_;
        return static_cast<std::uint32_t>(clusters_.size() - 1);
    }

    /// Inserts the pairs of `a` and its neighbours among the clusters before `end`.
    void offer(std::uint32_t a, std::uint32_t end) {
        const Sphere& own = clusters_[a].ball;
        for (std::uint32_t b = 0; b < end; ++b) {
            const Sphere& other = clusters_[b].ball;
            const double reach = 1.1 * (own.radius + other.radius) + 1e-3;
            if (!clusters_[b].alive || squared_norm(own.center - other.center) > reach * reach) {
                continue;
            }
            scratch_ = clusters_[a].points;
            scratch_.insert(scratch_.end(), clusters_[b].points.begin(), clusters_[b].points.end());
            const Sphere ball = minimum_enclosing_sphere(scratch_);
            const double cost = columns_.outside(std::span(&ball, 1));
            queue_.push({cost - clusters_[a].cost - clusters_[b].cost, b, a});
        }
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        std::vector<Vec3> points = std::move(clusters_[a].points);
        points.insert(points.end(), clusters_[b].points.begin(), clusters_[b].points.end());
        clusters_[b].points.clear();
        clusters_[a].alive = clusters_[b].alive = false;
        count_ -= 2;
        const std::uint32_t merged = add(std::move(points));
        offer(merged, merged);
    }

    const Columns& columns_;
    std::vector<Cluster> clusters_;
    std::priority_queue<Pair> queue_;
    std::vector<Vec3> scratch_;
    std::size_t count_ = 0;
};

} // namespace

std::vector<std::vector<Sphere>> merge(std::span<const Vec3> points, std::span<const Sphere> balls,
                                       const Columns& columns, Context& context) {
    if (balls.empty() || points.empty()) {
        return {};
    }
    Merger merger(points, balls, columns);
    std::vector<std::vector<Sphere>> results(merger.count());
    for (;;) {
        results[merger.count() - 1] = merger.balls();
        if (merger.count() <= 1) {
            return results;
        }
        context.check_cancelled();
        merger.step();
    }
}

} // namespace foam::medial
