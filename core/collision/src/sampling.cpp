#include "sampling.hpp"

#include <foam/base/parallel.hpp>
#include <foam/collision/separation.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline collision::self_collision {
namespace {

/// Samples per block. Each block has its own stream of random numbers, so that the result does not depend on the number
/// of threads.
constexpr std::size_t block_size = 1024;

} // namespace

Groups groups_of(const CollisionModel& model) {
    Groups groups(model.spheres.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!model.of(i).empty()) {
            groups[i].emplace(model.of(i));
        }
    }
    return groups;
}

PlacedLinks::PlacedLinks(const Kinematics& kinematics, const Groups& groups)
    : kinematics_(kinematics), groups_(groups), poses_(groups.size()), bounds_(groups.size()), spheres_(groups.size()) {
}

void PlacedLinks::place(std::span<const double> configuration) {
    kinematics_.link_poses(configuration, poses_);
    for (std::size_t link = 0; link < groups_.size(); ++link) {
        spheres_[link].clear();
        if (groups_[link]) {
            bounds_[link] = moved(poses_[link], groups_[link]->bound);
        }
    }
}

const std::vector<Sphere>& PlacedLinks::spheres(std::size_t link) {
    std::vector<Sphere>& result = spheres_[link];
    if (result.empty()) {
        for (const Sphere& sphere : groups_[link]->spheres) {
            result.push_back(moved(poses_[link], sphere));
        }
    }
    return result;
}

bool PlacedLinks::touching(std::size_t first, std::size_t second) {
    if (!touch(bounds_[first], bounds_[second])) {
        return false;
    }
    near_.clear();
    for (const Sphere& sphere : spheres(second)) {
        if (touch(bounds_[first], sphere)) {
            near_.push_back(sphere);
        }
    }
    const auto touches_near = [&](const Sphere& a) {
        return touch(a, bounds_[second]) &&
               std::any_of(near_.begin(), near_.end(), [&](const Sphere& b) { return touch(a, b); });
    };
    const std::vector<Sphere>& others = spheres(first);
    return (!near_.empty() && std::any_of(others.begin(), others.end(), touches_near)) ||
           touching_others(first, second);
}

bool PlacedLinks::touching_others(std::size_t first, std::size_t second) const {
    const BallGroup &a = *groups_[first], &b = *groups_[second];
    const auto meet = [&](const Element& e, const Sphere& bound_of_e, const Element& f, const Sphere& bound_of_f) {
        return touch(moved(poses_[first], bound_of_e), moved(poses_[second], bound_of_f)) &&
               separation(e, f, poses_[first], poses_[second]).low == 0;
    };
    for (const BoundedElement& f : b.others) {
        for (const BoundedElement& e : a.others) {
            if (meet(e.element, e.bound, f.element, f.bound)) {
                return true;
            }
        }
        for (const Sphere& e : a.spheres) {
            if (meet(element_of(e), e, f.element, f.bound)) {
                return true;
            }
        }
    }
    for (const BoundedElement& e : a.others) {
        for (const Sphere& f : b.spheres) {
            if (meet(e.element, e.bound, element_of(f), f)) {
                return true;
            }
        }
    }
    return false;
}

std::vector<std::size_t> count_touching(const Kinematics& kinematics, const Groups& groups,
                                        const std::vector<LinkPair>& pairs, std::size_t samples, std::uint64_t seed,
                                        const std::atomic<bool>* cancel) {
    std::vector<std::size_t> counts(pairs.size(), 0);
    if (pairs.empty()) {
        return counts;
    }
    const std::size_t blocks = (samples + block_size - 1) / block_size;
    std::vector<std::vector<std::size_t>> of_block(blocks, counts);
    parallel_for(blocks, [&](std::size_t block) {
        Random random(derive_seed(seed, fmt::format("configurations {}", block)));
        PlacedLinks links(kinematics, groups);
        const std::size_t size = std::min(block_size, samples - block * block_size);
        for (std::size_t i = 0; i < size && !(cancel && cancel->load(std::memory_order_relaxed)); ++i) {
            links.place(kinematics.random_configuration(random));
            for (std::size_t p = 0; p < pairs.size(); ++p) {
                of_block[block][p] += links.touching(pairs[p].first, pairs[p].second) ? 1 : 0;
            }
        }
    });
    for (const std::vector<std::size_t>& block : of_block) {
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            counts[p] += block[p];
        }
    }
    return counts;
}

} // namespace foam::collision::self_collision
