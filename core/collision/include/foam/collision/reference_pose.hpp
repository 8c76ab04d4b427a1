// The reference pose of a robot: one in which no links touch that can be apart.
#pragma once

#include <foam/collision/self_collision.hpp>
#include <foam/robot/robot.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] collision {

struct ReferencePoseOptions {
    JointValues given{}; ///< of the user; if there is any, this is the pose
    /// Tried in turn if none is given. Joints that mimic others, do not move, or that the robot does not have are left
    /// out.
    std::vector<GroupState> named{};
    JointValues held{};  ///< joints that keep these positions in every pose but a given one
    std::uint64_t seed = 0;
};

struct ReferenceConfiguration {
    enum class Source {
        given, ///< by the user, whether links touch or not
        named, ///< the first named pose in which no links touch
        zero,  ///< all joints at zero, moved into their limits: no links touch
        found, ///< no links touch; few joints are moved away from zero
        worst, ///< links touch in every pose that was tried: the zero pose
    };
    std::vector<double> configuration; ///< one value for each freedom
    Source source = Source::zero;
    std::string name; ///< of a named pose
    /// Pairs of links that are not adjacent and whose original geometry touches in it, though not in every
    /// configuration; only of a pose that is given, or the worst.
    LinkPairs touching;
};

/// Returns the reference pose. Links touch if their original geometry does (consequences_of()); links that are adjacent,
/// or that touch in each of 256 random configurations too, do not count. Equal seeds give equal poses. Throws
/// Error(usage) for a position of a joint that the robot does not have, that mimics another, or that does not move.
/// O(tries · pairs) tests of contact.
ReferenceConfiguration reference_configuration(const Kinematics& kinematics, const LinkSolids& solids,
                                               const ReferencePoseOptions& options = {});

/// Returns the values of the joints that are not at zero, moved into the limits, by name.
JointValues moved_joints(const Kinematics& kinematics, const std::vector<double>& configuration);

/// Returns a sentence: which pose it is, with the joints that are not at zero; for a pose in which links touch, which.
std::string sentence_about(const Kinematics& kinematics, const ReferenceConfiguration& reference);

} // namespace collision
} // namespace foam
