#include "link_shapes.hpp"

#include "ball_group.hpp"

#include <foam/robot/internal/chain.hpp>

namespace foam::inline collision {

std::vector<bool> LinkShapes::have_geometry() const {
    std::vector<bool> have(solids_.size());
    for (std::size_t i = 0; i < solids_.size(); ++i) {
        have[i] = has(i);
    }
    return have;
}

const ContactShape& LinkShapes::shape(std::size_t link) const {
    std::call_once(made_[link], [&] { shapes_[link] = std::make_unique<ContactShape>(solids_[link]); });
    return *shapes_[link];
}

bool LinkShapes::touching(std::size_t first, std::size_t second, std::span<const Pose> poses) const {
    if (!has(first) || !has(second)) {
        return false;
    }
    const ContactShape &a = shape(first), &b = shape(second);
    using namespace self_collision;
    return touch(moved(poses[first], a.bound()), moved(poses[second], b.bound())) &&
           a.touches(b, poses[first].inverse() * poses[second]);
}

LinkPairs pairs_apart(const Kinematics& kinematics, const LinkShapes& shapes) {
    const std::vector<bool> have = shapes.have_geometry();
    LinkPairs pairs;
    for (std::size_t a = 0; a < have.size(); ++a) {
        for (std::size_t b = a + 1; b < have.size(); ++b) {
            if (have[a] && have[b] && !joint_chain::adjacent(kinematics, have, a, b)) {
                pairs.emplace_back(a, b);
            }
        }
    }
    return pairs;
}

LinkPairs touching_in_all(const Kinematics& kinematics, const LinkShapes& shapes, LinkPairs pairs,
                          const std::vector<std::vector<double>>& configurations) {
    PlacedShapes placed(kinematics, shapes);
    for (const std::vector<double>& configuration : configurations) {
        if (pairs.empty()) {
            break;
        }
        placed.place(configuration);
        std::erase_if(pairs, [&](const auto& pair) { return !placed.touching(pair.first, pair.second); });
    }
    return pairs;
}

} // namespace foam::inline collision
