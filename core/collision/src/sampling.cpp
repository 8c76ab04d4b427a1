#include "pairs.hpp"

#include <algorithm>

namespace foam::inline collision::self_collision {
Groups groups_of(const CollisionModel& model) {
    Groups groups(model.elements.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!model.elements[i].empty()) {
            groups[i].emplace(model.elements[i]);
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
           shaped_touch(*groups_[first], poses_[first], *groups_[second], poses_[second]);
}

} // namespace foam::collision::self_collision
