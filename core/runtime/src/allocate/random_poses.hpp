// Random poses of the robot, in which its elements are compared with its geometry (budget: {for: poses}).
#pragma once

#include "allocate/exploration.hpp"

#include <foam/collision/consequences.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/runtime/internal/prepare.hpp>

#include <memory>
#include <vector>

namespace foam::inline runtime {

/// The poses of one run, and the original geometry of its links.
class RandomPoses {
public:
    /// `seed`: of the run.
    RandomPoses(std::shared_ptr<const Robot> robot, const std::vector<LinkWork>& links, std::uint64_t seed);

    static constexpr std::size_t count = 500;

    /// Returns what the elements of each link do in the poses, with those that it keeps, padded: one level for each of
    /// the run's links, in the link's frame. Throws Error(cancelled).
    Consequences consequences(const std::vector<Elements>& of_link);
    /// Returns the number of the run's links.
    std::size_t links() const { return links_.size(); }
    /// Returns the index in the robot's links of one of the run's.
    std::size_t robot_link(std::size_t link) const { return robot_links_[link]; }

private:
    const std::vector<LinkWork>& links_;
    std::shared_ptr<const Robot> robot_;
    Kinematics kinematics_;
    std::vector<std::size_t> robot_links_;
    LinkSolids solids_; ///< made when they are first needed
    std::vector<std::vector<double>> configurations_;
};

/// Returns an allocation with the fewest false contacts in the poses that was found: contacts of elements of two links
/// whose geometry does not touch. In each round the groups of links with false contacts weigh more, by their share of
/// them, and the budget is allocated anew. `shared`: the allocation without that, which is returned if none is better.
Shared with_fewer_false_contacts(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                 const std::vector<Group>& groups, const Goal& goal, RandomPoses& poses, Shared shared,
                                 Cut& cut);

} // namespace foam::runtime
