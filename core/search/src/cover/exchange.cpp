#include "exchange.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/sphere.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace foam::inline search::cover {
namespace {

Sphere sphere_of(const Ball& ball) {
    return {{ball.x, ball.y, ball.z}, ball.r};
}

bool meet(const Ball& a, const Ball& b) {
    const float sum = a.r + b.r;
    return squared_distance(a, b) < sum * sum;
}

} // namespace

Exchange::Exchange(const Problem& problem, const IndexedSurface& skin, const ExchangePlan& plan, Balls balls)
    : skin_(skin), plan_(plan), balls_(std::move(balls)), home_(skin.faces.size(), none), remainder_(skin),
      outside_(problem.occupancy, plan.cells), moved_(balls_.size(), 1) {
    find_homes();
}

bool Exchange::meet(std::size_t i, std::size_t j) const {
    return foam::cover::meet(balls_[i], balls_[j]);
}

bool Exchange::holds(const Ball& ball, const IndexedSurface::Face& face) const {
    constexpr float rounding = 4e-6f;
    const float squared = ball.r * ball.r * (1 + rounding);
    return std::all_of(face.corners.begin(), face.corners.end(), [&](std::uint32_t p) {
        return ball.squared_distance(skin_.points.x[p], skin_.points.y[p], skin_.points.z[p]) <= squared;
    });
}

/// Finds the home of each face. Consecutive faces are often close together: the balls near several of them are found at
/// once. A face whose ball has not moved keeps it, and one without a ball may get one that moved.
void Exchange::find_homes() {
    constexpr std::size_t at_once = 32;
    for (std::size_t begin = 0; begin < home_.size(); begin += at_once) {
        const auto faces = std::span(skin_.faces).subspan(begin, std::min(at_once, home_.size() - begin));
        near_.clear();
        for (std::size_t k = 0; k < faces.size(); ++k) {
            std::uint32_t& home = home_[begin + k];
            if (home == none || (moved_[home] && !holds(balls_[home], faces[k]))) {
                if (near_.empty()) {
                    find_near(faces);
                }
                const auto first = std::find_if(near_.begin(), near_.end(), [&](auto i) {
                    return (home != none || moved_[i]) && holds(balls_[i], faces[k]);
                });
                home = first == near_.end() ? none : *first;
            }
        }
    }
    moved_.assign(balls_.size(), 0);
}

/// Finds the balls that may contain one of the faces, in order.
void Exchange::find_near(std::span<const IndexedSurface::Face> faces) {
    constexpr float rounding = 1.001f;
    Box box;
    for (const auto& [corners, edges, bounds] : faces) {
        box.add(Vec3{bounds.x, bounds.y, bounds.z});
    }
    const Ball middle = ball_of({box.center(), box.diagonal() / 2});
    near_.clear();
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
        const float reach = (balls_[i].r + middle.r) * rounding;
        if (squared_distance(balls_[i], middle) <= reach * reach) {
            near_.push_back(i);
        }
    }
}

void Exchange::look_at(std::size_t i, std::size_t j, const Ball& region) {
    if (std::any_of(moved_.begin(), moved_.end(), [](char moved) { return moved; })) {
        find_homes();
    }
    faces_.clear();
    for (std::uint32_t f = 0; f < home_.size(); ++f) {
        const Ball& bounds = skin_.faces[f].bounds;
        const auto near = [&](std::size_t k) {
            const float sum = balls_[k].r + bounds.r;
            return squared_distance(balls_[k], bounds) <= sum * sum;
        };
        if (home_[f] == i || home_[f] == j || (home_[f] == none && (near(i) || near(j)))) {
            faces_.push_back(f);
        }
    }
    // Balls that meet neither of the two may contain parts of a face that reaches far beyond both.
    others_ = balls_;
    others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(std::max(i, j)));
    if (i != j) {
        others_.erase(others_.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)));
    }
    remainder_.find(faces_, others_, content_);
    std::erase_if(others_,
                  [&](const Ball& other) { return !cover::meet(other, balls_[i]) && !cover::meet(other, balls_[j]); });
    outside_.look(others_, region);
}

bool Exchange::split(const std::vector<std::size_t>& candidates) {
    std::vector<TwoBalls> starts;
    std::size_t chosen = balls_.size();
    double most = -std::numeric_limits<double>::infinity();
    for (const std::size_t i : candidates) {
        look_at(i, i, balls_[i]);
        if (content_.points.size() < 2) {
            continue;
        }
        std::vector<TwoBalls> found = TwoBallSearch(content_, outside_).anywhere(plan_.split);
        const double gain = outside_.of({&balls_[i], 1}) - found.front().volume;
        if (gain > most) {
            most = gain;
            starts = std::move(found);
            chosen = i;
        }
    }
    if (chosen == balls_.size()) {
        return false;
    }
    look_at(chosen, chosen, balls_[chosen]);
    const TwoBalls best = TwoBallSearch(content_, outside_).improved(starts, plan_.split);
    if (!(best.balls[0].r > 0 && best.balls[1].r > 0)) {
        return false;
    }
    balls_[chosen] = best.balls[0];
    balls_.push_back(best.balls[1]);
    moved_[chosen] = 1;
    moved_.push_back(1);
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
    moved_[i] = moved_[j] = 1;
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

} // namespace foam::search::cover
