#include "by_spheres/moves/moves.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/sphere.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace foam::inline search::by_spheres {
namespace {

Sphere sphere_of(const Ball& ball) {
    return {{ball.x, ball.y, ball.z}, ball.r};
}

} // namespace

Exchange::Exchange(const Problem& problem, const IndexedSurface& skin, const ExchangePlan& plan, Balls balls)
    : skin_(skin), plan_(plan), balls_(std::move(balls)), home_(skin.faces.size(), none), remainder_(skin),
      outside_(problem.occupancy, plan.cells), moved_(balls_.size()) {
    std::iota(moved_.begin(), moved_.end(), 0u);
    find_homes();
}

void Exchange::take(const Balls& balls) {
    if (balls.size() < balls_.size()) {
        std::fill(home_.begin(), home_.end(), none);
        balls_.clear();
    }
    moved_.clear();
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        if (i >= balls_.size() || balls_[i] != balls[i]) {
            moved_.push_back(i);
        }
    }
    balls_ = balls;
    find_homes();
}

bool Exchange::meet(std::size_t i, std::size_t j) const {
    return foam::by_spheres::meet(balls_[i], balls_[j]);
}

bool Exchange::holds(const Ball& ball, const IndexedSurface::Face& face) const {
    constexpr float rounding = 4e-6f;
    const float squared = ball.r * ball.r * (1 + rounding);
    return std::all_of(face.corners.begin(), face.corners.end(), [&](std::uint32_t p) {
        return ball.squared_distance(skin_.points.x[p], skin_.points.y[p], skin_.points.z[p]) <= squared;
    });
}

std::uint32_t Exchange::home_of(const IndexedSurface::Face& face, std::span<const std::uint32_t> balls) const {
    const auto first =
        std::find_if(balls.begin(), balls.end(), [&](std::uint32_t i) { return holds(balls_[i], face); });
    return first == balls.end() ? none : *first;
}

/// Finds the home of each face. Consecutive faces are often close together: the balls near several of them are found at
/// once. A face whose ball has not moved keeps it, and one without a ball may get one that moved.
void Exchange::find_homes() {
    constexpr std::size_t at_once = 32;
    std::vector<char> moved(balls_.size(), 0);
    for (const std::uint32_t i : moved_) {
        moved[i] = 1;
    }
    for (std::size_t begin = 0; begin < home_.size(); begin += at_once) {
        const auto faces = std::span(skin_.faces).subspan(begin, std::min(at_once, home_.size() - begin));
        bool near_known = false, moved_known = false;
        for (std::size_t k = 0; k < faces.size(); ++k) {
            std::uint32_t& home = home_[begin + k];
            if (home == none) {
                if (!std::exchange(moved_known, true)) {
                    find_near(faces, moved_, moved_near_);
                }
                home = home_of(faces[k], moved_near_);
            } else if (moved[home] && !holds(balls_[home], faces[k])) {
                if (!std::exchange(near_known, true)) {
                    all_.resize(balls_.size());
                    std::iota(all_.begin(), all_.end(), 0u);
                    find_near(faces, all_, near_);
                }
                home = home_of(faces[k], near_);
            }
        }
    }
    moved_.clear();
}

/// Finds those of the balls that may contain one of the faces, in order.
void Exchange::find_near(std::span<const IndexedSurface::Face> faces, const std::vector<std::uint32_t>& from,
                         std::vector<std::uint32_t>& near) const {
    constexpr float rounding = 1.001f;
    Box box;
    for (const auto& [corners, edges, bounds] : faces) {
        box.add(Vec3{bounds.x, bounds.y, bounds.z});
    }
    const Ball middle = ball_of({box.center(), box.diagonal() / 2});
    near.clear();
    for (const std::uint32_t i : from) {
        const float reach = (balls_[i].r + middle.r) * rounding;
        if (squared_distance(balls_[i], middle) <= reach * reach) {
            near.push_back(i);
        }
    }
}

void Exchange::look_at(std::size_t i, std::size_t j, const Ball& region) {
    constexpr float rounding = 1.0001f;
    if (!moved_.empty()) {
        find_homes();
    }
    faces_.clear();
    Ball reach = region;
    for (std::uint32_t f = 0; f < home_.size(); ++f) {
        const Ball& bounds = skin_.faces[f].bounds;
        const auto near = [&](std::size_t k) {
            const float sum = balls_[k].r + bounds.r;
            return squared_distance(balls_[k], bounds) <= sum * sum;
        };
        const bool own = home_[f] == i || home_[f] == j;
        if (!own && !near(i) && !near(j)) {
            continue;
        }
        reach.r = std::max(reach.r, std::sqrt(squared_distance(region, bounds)) + bounds.r);
        if (own || home_[f] == none) {
            faces_.push_back(f);
        }
    }
    reach.r *= rounding;
    reach_ = reach;
    // Balls that meet neither of the two may contain parts of a face that reaches far beyond both.
    find_others(i, j, reach);
    remainder_.find(faces_, others_, content_);
    std::erase_if(others_,
                  [&](const Ball& other) { return !by_spheres::meet(other, balls_[i]) && !by_spheres::meet(other, balls_[j]); });
    outside_.look(others_, region);
}

void Exchange::look_at(std::size_t ball) {
    constexpr float margin = 1.001f; // for parts that no ball quite contains
    if (skin_.is_coarse) {
        look_at(ball, ball, balls_[ball]); // parts that no ball contains may reach far
        return;
    }
    if (!moved_.empty()) {
        find_homes();
    }
    const Ball& region = balls_[ball];
    reach_ = region;
    reach_.r *= margin;
    faces_.clear();
    for (std::uint32_t f = 0; f < home_.size(); ++f) {
        if ((home_[f] == ball || home_[f] == none) && by_spheres::meet(skin_.faces[f].bounds, reach_)) {
            faces_.push_back(f);
        }
    }
    find_others(ball, ball, reach_);
    remainder_.find_within(reach_, faces_, others_, content_);
    outside_.look(others_, region);
}

void Exchange::find_others(std::size_t i, std::size_t j, const Ball& reach) {
    others_.clear();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
        if (k != i && k != j && by_spheres::meet(balls_[k], reach)) {
            others_.push_back(balls_[k]);
        }
    }
}

Exchange::Look Exchange::look_at_splits(std::size_t ball) {
    look_at(ball);
    Look look{-std::numeric_limits<double>::infinity(), {}, reach_};
    if (content_.points.size() >= 2) {
        look.starts = TwoBallSearch(content_, outside_).anywhere(plan_.split);
        look.gain = outside_.of({&balls_[ball], 1}) - look.starts.front().volume;
    }
    return look;
}

std::optional<std::array<Ball, 2>> Exchange::best_split(std::size_t ball, const std::vector<TwoBalls>& starts) {
    look_at(ball);
    const TwoBalls best = TwoBallSearch(content_, outside_).improved(starts, plan_.split);
    if (!(best.balls[0].r > 0 && best.balls[1].r > 0)) {
        return std::nullopt;
    }
    return best.balls;
}

bool Exchange::split(const std::vector<std::size_t>& candidates) {
    Look best{-std::numeric_limits<double>::infinity(), {}, {}};
    std::size_t chosen = balls_.size();
    for (const std::size_t i : candidates) {
        if (Look look = look_at_splits(i); look.gain > best.gain) {
            best = std::move(look);
            chosen = i;
        }
    }
    if (chosen == balls_.size()) {
        return false;
    }
    const auto two = best_split(chosen, best.starts);
    if (!two) {
        return false;
    }
    balls_[chosen] = two->front();
    moved_ = {static_cast<std::uint32_t>(chosen), static_cast<std::uint32_t>(balls_.size())};
    balls_.push_back(two->back());
    return true;
}

bool Exchange::exchange(std::size_t i, std::size_t j) {
    constexpr double least_gain = 2e-4; // share of the larger ball's cube
    const Ball a = balls_[i], b = balls_[j];
    look_at(i, j, ball_of(enclosing_sphere(sphere_of(a), sphere_of(b))));
    const double before = outside_.of(std::array{a, b});
    const TwoBalls two = TwoBallSearch(content_, outside_).near({a, b}, plan_.evaluations);
    const double size = std::max(a.r, b.r);
    if (two.volume > before - least_gain * size * size * size) {
        return false;
    }
    balls_[i] = two.balls[0];
    balls_[j] = two.balls[1];
    const auto [first, second] = std::minmax(i, j);
    moved_ = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
    return true;
}

void Exchange::settle() {
    std::set<std::pair<std::size_t, std::size_t>> open;
    const auto open_about = [&](std::size_t i) {
        for (std::size_t k = 0; k < balls_.size(); ++k) {
            if (k != i && meet(k, i)) {
                open.insert(std::minmax(i, k));
            }
        }
    };
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        open_about(i);
    }
    for (int round = 0; round < plan_.rounds && !open.empty(); ++round) {
        check_cancelled();
        const auto now = std::exchange(open, {});
        for (const auto& [i, j] : now) {
            if (meet(i, j) && exchange(i, j)) {
                open_about(i);
                open_about(j);
            }
        }
    }
}

} // namespace foam::inline search::by_spheres
