#include "by_spheres/moves/moves.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>

namespace foam::inline search::by_spheres {

Merging::Merging(const FineSurface& skin, const Occupancy& occupancy, const Balls& balls) : occupancy_(occupancy) {
    PowerCells cells(skin);
    balls_ = cells.shared(balls);
    parts_ = cells.parts();
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        balls_[i] = enclosing_ball_.of(parts_[i], parts_[i].size(), {}, center_of(balls_[i]));
    }
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        add_pairs(i, i + 1);
    }
}

Balls Merging::balls() const {
    Balls left = balls_;
    std::erase_if(left, [](const Ball& ball) { return !(ball.r > 0); });
    return left;
}

void Merging::add_pairs(std::size_t ball, std::size_t begin) {
    check_cancelled();
    for (std::size_t other = begin; other < balls_.size(); ++other) {
        if (other != ball && balls_[other].r > 0 && meet(balls_[ball], balls_[other])) {
            pairs_.push_back(priced(ball, other));
        }
    }
}

Merging::Pair Merging::priced(std::size_t first, std::size_t second) {
    const Ball &a = balls_[first], &b = balls_[second];
    Points both = parts_[first];
    both.append(parts_[second]);
    const Ball merged = enclosing_ball_.of(both, both.size(), {}, center_of(a));
    near_.clear();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
        const Ball& ball = balls_[k];
        if (k != first && k != second && ball.r > 0 && (meet(ball, merged) || meet(ball, a) || meet(ball, b))) {
            near_.push_back(ball);
        }
    }
    return {first, second, merged, added_volume(merged, a, b, near_, occupancy_)};
}

/// Prices near a merged ball change little, and most of those pairs are far from the cheapest: a pair is priced anew
/// when its turn comes.
bool Merging::merge_two() {
    auto cheapest = std::ranges::min_element(pairs_, {}, &Pair::price);
    while (cheapest != pairs_.end() && cheapest->outdated) {
        *cheapest = priced(cheapest->first, cheapest->second);
        cheapest = std::ranges::min_element(pairs_, {}, &Pair::price);
    }
    if (cheapest == pairs_.end()) {
        return false;
    }
    const Pair pair = *cheapest;
    std::erase_if(pairs_, [&](const Pair& other) { return other.has(pair.first) || other.has(pair.second); });
    balls_[pair.first] = pair.merged;
    parts_[pair.first].append(parts_[pair.second]);
    balls_[pair.second] = {};
    parts_[pair.second].clear();
    for (Pair& other : pairs_) {
        other.outdated |= meet(balls_[other.first], pair.merged) || meet(balls_[other.second], pair.merged);
    }
    add_pairs(pair.first, 0);
    return true;
}

std::vector<Balls> merged_sets(const FineSurface& skin, const Occupancy& occupancy, const Balls& balls,
                               std::size_t fewest) {
    Merging merging(skin, occupancy, balls);
    std::vector<Balls> sets;
    Balls now = merging.balls();
    sets.resize(now.size() + 1);
    while (now.size() >= fewest) {
        sets[now.size()] = now;
        if (!merging.merge_two()) {
            break;
        }
        now = merging.balls();
    }
    return sets;
}

} // namespace foam::inline search::by_spheres
