#include "cover/starts/waiting_points.hpp"

#include <foam/base/cancellation.hpp>

namespace foam::inline search::cover {

WaitingPoints::WaitingPoints(const Points& all, std::size_t begin) : all_(all) {
    for (std::size_t i = begin; i < all.size(); ++i) {
        waiting_.push_back({static_cast<std::uint32_t>(i), 0});
    }
}

void WaitingPoints::add_outside(const Balls& balls, Points& active) {
    std::size_t left = 0;
    CancellationCounter often(256);
    for (const Waiting& w : waiting_) {
        often.check();
        if (const auto owner = owner_of(w, balls)) {
            waiting_[left++] = {w.point, *owner};
        } else {
            active.add(all_, w.point);
        }
    }
    waiting_.resize(left);
}

std::optional<std::uint32_t> WaitingPoints::owner_of(const Waiting& waiting, const Balls& balls) const {
    const float x = all_.x[waiting.point], y = all_.y[waiting.point], z = all_.z[waiting.point];
    const auto held = [&](const Ball& b) { return b.squared_distance(x, y, z) <= b.r * b.r; };
    if (held(balls[waiting.owner])) {
        return waiting.owner;
    }
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        if (held(balls[i])) {
            return i;
        }
    }
    return std::nullopt;
}

} // namespace foam::inline search::cover
