#include "near_balls.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace foam::inline search::cover {
namespace {

/// Margin of the lists, as a share of the balls' mean radius.
constexpr float share_of_radius = 0.25f;
/// Share of the margin that is kept for rounding.
constexpr float share_for_rounding = 1e-3f;

/// Returns the largest sum of how far a ball moved and how much it grew.
float largest_change(const Balls& from, const Balls& to) {
    float most = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        most = std::max(most, std::sqrt(squared_distance(from[i], to[i])) + std::abs(to[i].r - from[i].r));
    }
    return most;
}

} // namespace

void NearBalls::update(const Balls& balls) {
    if (then_.size() == balls.size()) {
        left_ = margin_ * (1 - share_for_rounding) - 2 * largest_change(then_, balls);
    }
    if (then_.size() != balls.size() || !(left_ >= 0)) {
        find(balls);
    }
}

/// Sweeps along x: only balls whose ranges meet there are compared.
void NearBalls::find(const Balls& balls) {
    then_ = balls;
    float sum = 0;
    for (const Ball& ball : balls) {
        sum += ball.r;
    }
    margin_ = share_of_radius * sum / static_cast<float>(balls.size());
    left_ = margin_ * (1 - share_for_rounding);
    all_.resize(balls.size());
    std::iota(all_.begin(), all_.end(), 0u);
    const auto low = [&](std::uint32_t i) { return balls[i].x - balls[i].r; };
    order_ = all_;
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return low(a) < low(b); });
    lists_.resize(balls.size());
    for (std::vector<std::uint32_t>& list : lists_) {
        list.clear();
    }
    CancellationCounter often(64);
    for (std::size_t a = 0; a < order_.size(); ++a) {
        often.check();
        const Ball& ball = balls[order_[a]];
        const float end = ball.x + ball.r + margin_;
        for (std::size_t b = a + 1; b < order_.size() && !(low(order_[b]) > end); ++b) {
            const Ball& other = balls[order_[b]];
            const float reach = ball.r + other.r + margin_;
            if (!(squared_distance(ball, other) > reach * reach)) {
                lists_[order_[a]].push_back(order_[b]);
                lists_[order_[b]].push_back(order_[a]);
            }
        }
    }
    for (std::vector<std::uint32_t>& list : lists_) {
        std::sort(list.begin(), list.end());
    }
}

std::span<const std::uint32_t> NearBalls::of(std::size_t i, float gap) const {
    return gap <= left_ ? std::span<const std::uint32_t>(lists_[i]) : std::span<const std::uint32_t>(all_);
}

} // namespace foam::inline search::cover
