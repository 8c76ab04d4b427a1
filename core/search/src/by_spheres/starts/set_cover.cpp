#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {
namespace {

class SetCover {
public:
    SetCover(const DistanceField& field, const Points& points) : nodes_(field.nodes_within_bounds(most_nodes)) {
        const std::size_t columns = points.size();
        needed_.reserve(nodes_.distance.size() * columns);
        longest_ = std::numeric_limits<float>::infinity();
        for (std::size_t c = 0; c < nodes_.distance.size(); ++c) {
            const Ball node{nodes_.places.x[c], nodes_.places.y[c], nodes_.places.z[c], 0};
            float most = -longest_;
            for (std::size_t p = 0; p < columns; ++p) {
                const float squared = node.squared_distance(points.x[p], points.y[p], points.z[p]);
                needed_.push_back(std::sqrt(squared) + nodes_.distance[c]);
                most = std::max(most, needed_.back());
            }
            longest_ = std::min(longest_, most);
        }
        left_.resize(columns);
    }

    /// Returns the length with which one ball contains all points.
    float longest() const { return longest_; }

    /// Returns the greedy covering balls dilated by `length`; empty if more than `count` are needed.
    Balls greedy(float length, std::size_t count) {
        std::fill(left_.begin(), left_.end(), char{1});
        std::size_t rest = left_.size();
        Balls balls;
        while (rest > 0) {
            if (balls.size() == count) {
                return {};
            }
            std::size_t best = 0;
            int most = -1;
            for (std::size_t c = 0; c < nodes_.distance.size(); ++c) {
                if (const int held = held_of_rest(c, length); held > most) {
                    most = held;
                    best = c;
                }
            }
            if (most <= 0) {
                return {};
            }
            rest -= static_cast<std::size_t>(most);
            for (std::size_t p = 0; p < left_.size(); ++p) {
                left_[p] = left_[p] && needed_[best * left_.size() + p] > length;
            }
            balls.push_back(
                {nodes_.places.x[best], nodes_.places.y[best], nodes_.places.z[best], length - nodes_.distance[best]});
        }
        return balls;
    }

private:
    static constexpr std::size_t most_nodes = 800;

    int held_of_rest(std::size_t node, float length) const {
        const float* needed = needed_.data() + node * left_.size();
        int held = 0;
        for (std::size_t p = 0; p < left_.size(); ++p) {
            held += left_[p] & (needed[p] <= length);
        }
        return held;
    }

    DistanceField::Nodes nodes_;
    std::vector<float> needed_; ///< node by node: the dilation needed to contain each point
    float longest_ = 0;
    std::vector<char> left_; ///< 1: no ball contains the point yet
};

} // namespace

Balls dilated_inner_balls(const DistanceField& field, const Points& points, std::size_t count) {
    constexpr int halvings = 9;
    SetCover cover(field, points);
    Balls best;
    float low = 0, high = cover.longest();
    for (int i = 0; i < halvings; ++i) {
        check_cancelled();
        const float length = (low + high) / 2;
        if (Balls balls = cover.greedy(length, count); !balls.empty()) {
            best = std::move(balls);
            high = length;
        } else {
            low = length;
        }
    }
    return best;
}

} // namespace foam::search::by_spheres
