#include "by_spheres/moves/near_balls.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace foam::inline search::by_spheres {
namespace {

/// Margin of the lists, as a share of the balls' mean radius.
constexpr float share_of_radius = 0.25f;
/// Share of the margin that is kept for rounding.
constexpr float share_for_rounding = 1e-3f;

/// Returns the least coordinate along x.
float low_end(const Ball& ball) {
    return ball.x - ball.r;
}

/// Returns the largest sum of how far a ball moved and how much it grew.
float largest_change(const Balls& from, const Balls& to) {
    float most = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        most = std::max(most, std::sqrt(squared_distance(from[i], to[i])) + std::abs(to[i].r - from[i].r));
    }
    return most;
}

} // namespace

void NearBalls::update(const Balls& balls, float gap) {
    if (then_.size() == balls.size()) {
        left_ = margin_ * (1 - share_for_rounding) - 2 * largest_change(then_, balls);
    }
    if (then_.size() != balls.size() || !(left_ >= gap)) {
        find(balls, gap);
    }
}

/// Sweeps along x: only balls whose ranges meet there are compared.
void NearBalls::find(const Balls& balls, float gap) {
    then_ = balls;
    float sum = 0;
    for (const Ball& ball : balls) {
        sum += ball.r;
    }
    margin_ = gap + share_of_radius * sum / static_cast<float>(balls.size());
    left_ = margin_ * (1 - share_for_rounding);
    const auto low = [&](std::uint32_t i) { return low_end(balls[i]); };
    order_.resize(balls.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, {}, low);
    high_.clear();
    for (const std::uint32_t i : order_) {
        const float high = balls[i].x + balls[i].r;
        high_.push_back(high_.empty() ? high : std::max(high, high_.back()));
    }
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

std::span<const std::uint32_t> NearBalls::of(std::size_t i, float gap) {
    if (gap <= left_) {
        return lists_[i];
    }
    look_up(i, gap);
    return looked_up_;
}

void NearBalls::look_up(std::size_t i, float gap) {
    const float within = gap + (margin_ - left_); // where the balls were at the last search
    const Ball& ball = then_[i];
    const float begin = ball.x - ball.r - within, end = ball.x + ball.r + within;
    looked_up_.clear();
    for (auto k = static_cast<std::size_t>(std::ranges::lower_bound(high_, begin) - high_.begin());
         k < order_.size() && !(low_end(then_[order_[k]]) > end); ++k) {
        const float reach = ball.r + then_[order_[k]].r + within;
        if (order_[k] != i && !(squared_distance(ball, then_[order_[k]]) > reach * reach)) {
            looked_up_.push_back(order_[k]);
        }
    }
    std::ranges::sort(looked_up_);
}

static inline void press(Held& h, Ball& ball) {
    const float dx = h.x - ball.x, dy = h.y - ball.y, dz = h.z - ball.z;
    const float squared = dx * dx + dy * dy + dz * dz;
    if (h.force == 0 && squared <= ball.r * ball.r) {
        return;
    }
    const float distance = std::sqrt(squared);
    const float change = std::max((distance - ball.r) / 2, -h.force);
    h.force += change;
    const float share = distance > 0 ? change / distance : 0;
    ball.x += share * dx;
    ball.y += share * dy;
    ball.z += share * dz;
    ball.r += change;
}

void take_in(std::vector<Held>& held, Balls& balls, std::vector<char>& pressed) {
    constexpr int sweeps = 8; // after the first one
    for (Held& h : held) {
        press(h, balls[h.owner]);
    }
    std::size_t pressing = held.size();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        check_cancelled();
        std::size_t left = 0;
        for (std::size_t k = 0; k < pressing; ++k) {
            if (held[k].force > 0) {
                press(held[k], balls[held[k].owner]);
                if (k != left) {
                    std::swap(held[k], held[left]);
                }
                ++left;
            }
        }
        pressing = left;
    }
    for (std::size_t k = pressing; k < held.size(); ++k) {
        press(held[k], balls[held[k].owner]);
    }
    for (const Held& h : held) {
        pressed[h.point] = h.force > 0;
    }
}

} // namespace foam::inline search::by_spheres
