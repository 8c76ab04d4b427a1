#include "by_spheres/descent/descent.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace foam::inline search::by_spheres {

void Descent::run(Points& points, Balls& balls, const DescentPlan& plan, const Refresh& refresh) {
    owner_.assign(points.size(), 0);
    pressed_.assign(points.size(), 0);
    mean_.assign(balls.size(), {});
    square_ = 0;
    mean_scale_ = square_scale_ = 1;
    StepLengths lengths(balls, plan.steps, plan.first_step, plan.last_step);
    for (int i = 0; i < plan.steps; ++i, lengths.advance()) {
        check_cancelled();
        const float length = lengths.now();
        if (refresh && i % plan.refresh == 0) {
            refresh(points, length);
            owner_.resize(points.size(), 0);
            pressed_.resize(points.size(), 0);
        }
        slopes_.assign(balls.size(), {});
        add_exposed_areas(balls, directions_[static_cast<std::size_t>(i) % directions_.size()]);
        step(balls, length);
        hold(points, balls, length);
    }
}

void Descent::add_exposed_areas(const Balls& balls, const Points& directions) {
    near_.update(balls);
    CancellationCounter often(64);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        often.check();
        if (!exposed_.look(balls, i, directions, near_.of(i))) {
            continue;
        }
        slopes_[i] = slope_of(exposed_, balls[i], directions,
                              [&](float x, float y, float z) { return occupancy_.outside(x, y, z); });
    }
}

void Descent::find_doubtful(const Points& points, const Balls& balls, float slack) {
    first_.assign(balls.size() + 1, 0);
    doubtful_index_.clear();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Ball& last = balls[owner_[p]];
        const float inner = last.r - slack;
        if (!(inner > 0) || last.squared_distance(points.x[p], points.y[p], points.z[p]) > inner * inner) {
            doubtful_index_.push_back(static_cast<std::uint32_t>(p));
            ++first_[owner_[p] + 1];
        }
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    // Counting sort from the end: the end of a ball's points becomes their beginning.
    sorted_.resize(doubtful_index_.size());
    doubtful_.resize(doubtful_index_.size());
    for (std::size_t k = doubtful_index_.size(); k-- > 0;) {
        const std::uint32_t p = doubtful_index_[k];
        const std::size_t place = --first_[owner_[p] + 1];
        sorted_[place] = p;
        doubtful_.x[place] = points.x[p];
        doubtful_.y[place] = points.y[p];
        doubtful_.z[place] = points.z[p];
    }
    std::swap(doubtful_index_, sorted_);
    first_.erase(first_.begin());
    first_.push_back(doubtful_index_.size());
    deepest_.clear(doubtful_.size());
    near_.update(balls, 4 * slack); // few points are left outside by more than twice the length of a step
    far_out_.clear();
    CancellationCounter often(64);
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        often.check();
        deepest_.offer(doubtful_, first_[i], first_[i + 1], balls, {&i, 1});
        offer_near(i, first_[i], first_[i + 1], balls);
    }
    if (!far_out_.empty()) {
        offer_far_out(balls);
    }
}

/// Neighbours of a ball are enough for points that are not far outside it.
void Descent::offer_near(std::size_t i, std::size_t begin, std::size_t end, const Balls& balls) {
    const float listed = near_.listed_gap();
    float most = -balls[i].r;
    for (std::size_t k = begin; k < end; ++k) {
        if (2 * deepest_.gap[k] > listed) {
            far_out_.push_back(k);
            most = listed / 2;
        } else {
            most = std::max(most, deepest_.gap[k]);
        }
    }
    offer_within(2 * most, i, begin, end, balls);
}

/// The ball of least power is deep enough: neighbours of this one are few.
void Descent::offer_far_out(const Balls& balls) {
    far_points_.clear();
    for (const std::size_t k : far_out_) {
        far_points_.add(doubtful_, k);
    }
    far_owners_.find(far_points_, balls);
    for (std::size_t f = 0; f < far_out_.size(); ++f) {
        const std::size_t k = far_out_[f];
        deepest_.offer(doubtful_, k, k + 1, balls, {&far_owners_.owner[f], 1});
        offer_within(2 * deepest_.gap[k], deepest_.ball[k], k, k + 1, balls);
    }
}

void Descent::offer_within(float gap, std::size_t i, std::size_t begin, std::size_t end, const Balls& balls) {
    rivals_.clear();
    for (const std::uint32_t other : begin < end ? near_.of(i, gap) : std::span<const std::uint32_t>()) {
        const float reach = balls[i].r + balls[other].r + gap;
        if (other != i && reach > 0 && squared_distance(balls[i], balls[other]) <= reach * reach) {
            rivals_.push_back(other);
        }
    }
    deepest_.offer(doubtful_, begin, end, balls, rivals_);
}

void Descent::hold(const Points& points, Balls& balls, float slack) {
    find_doubtful(points, balls, slack);
    held_.clear();
    for (std::size_t k = 0; k < doubtful_.size(); ++k) {
        owner_[doubtful_index_[k]] = deepest_.ball[k];
        if (deepest_.gap[k] > -slack) {
            held_.push_back({doubtful_.x[k], doubtful_.y[k], doubtful_.z[k], 0, deepest_.ball[k], doubtful_index_[k]});
        }
    }
    // Points active in the last step come first: most of the others are then already contained.
    std::stable_partition(held_.begin(), held_.end(), [&](const Held& h) { return pressed_[h.point] != 0; });
    take_in(held_, balls, pressed_);
}

void Descent::step(Balls& balls, float length) {
    constexpr float mean_decay = 0.8f, square_decay = 0.95f, longest = 4;
    mean_scale_ *= mean_decay;
    square_scale_ *= square_decay;
    // One scale for all: a point that two balls could contain goes to the one that loses least by it only if both gain
    // at the same rate. With a scale for each ball, a descent drifts away from the least volume.
    float square = 0;
    for (const Slope& s : slopes_) {
        square += (s.x * s.x + s.y * s.y + s.z * s.z + s.r * s.r) / (4 * static_cast<float>(balls.size()));
    }
    square_ = square_decay * square_ + (1 - square_decay) * square;
    const float rms = std::sqrt(square_ / (1 - square_scale_));
    const float scale = rms > 0 ? length / (1 - mean_scale_) / rms : 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Slope& s = slopes_[i];
        Slope& m = mean_[i];
        m = {mean_decay * m.x + (1 - mean_decay) * s.x, mean_decay * m.y + (1 - mean_decay) * s.y,
             mean_decay * m.z + (1 - mean_decay) * s.z, mean_decay * m.r + (1 - mean_decay) * s.r};
        const float step = scale * std::sqrt((m.x * m.x + m.y * m.y + m.z * m.z + m.r * m.r) / 4);
        const float share = step > longest * length ? scale * longest * length / step : scale;
        balls[i].x -= share * m.x;
        balls[i].y -= share * m.y;
        balls[i].z -= share * m.z;
        balls[i].r = std::max(balls[i].r - share * m.r, 1e-6f);
    }
}

} // namespace foam::search::by_spheres
