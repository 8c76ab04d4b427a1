// The frequency of contact of pairs of links in random configurations.
#pragma once

#include "ball_group.hpp"

#include <foam/collision/self_collision.hpp>

#include <optional>
#include <span>
#include <vector>

namespace foam::inline collision::self_collision {

/// One entry per link of the robot; empty: it has no elements.
using Groups = std::vector<std::optional<BallGroup>>;
Groups groups_of(const CollisionModel& model);

/// The spheres of all links in one configuration. A link's spheres are transformed at their first use.
class PlacedLinks {
public:
    PlacedLinks(const Kinematics& kinematics, const Groups& groups);
    void place(std::span<const double> configuration);
    bool touching(std::size_t first, std::size_t second);

private:
    const std::vector<Sphere>& spheres(std::size_t link);
    bool touching_others(std::size_t first, std::size_t second) const;

    const Kinematics& kinematics_;
    const Groups& groups_;
    std::vector<Pose> poses_;
    std::vector<Sphere> bounds_;
    std::vector<std::vector<Sphere>> spheres_; ///< empty: not transformed yet
    std::vector<Sphere> near_;
};

/// Returns for each pair in how many of `samples` random configurations it touches.
std::vector<std::size_t> count_touching(const Kinematics& kinematics, const Groups& groups,
                                        const std::vector<LinkPair>& pairs, std::size_t samples, std::uint64_t seed,
                                        const std::atomic<bool>* cancel);

} // namespace foam::collision::self_collision
