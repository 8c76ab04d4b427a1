// The self-collision matrix: the pairs of a robot's links that never need a collision check, as an SRDF's
// <disable_collisions> lists them. Pairs are proved where possible; elsewhere samples decide, with a stated confidence.
#pragma once

#include <foam/geometry/sphere.hpp>
#include <foam/robot/facts.hpp>
#include <foam/robot/kinematics.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] collision {

/// The elements of each link.
struct CollisionModel {
    /// The source of the elements of a link.
    enum class Source {
        none,  ///< the link has no collision geometry
        given, ///< they are the geometry, or come from a sphere file
        cover, ///< computed here, certified to cover the link's geometry
    };
    std::shared_ptr<const Robot> robot;
    std::vector<std::vector<Sphere>> spheres; ///< of each link of the robot, in its frame
    std::vector<Source> sources;              ///< of each link of the robot
    std::vector<std::string> notes;           ///< warnings of the loaders, and what is left out
    std::vector<std::vector<Element>> others{}; ///< elements of other kinds of each link; empty: none of any link

    /// The elements of a link; without any it never collides.
    ElementsView of(std::size_t link) const {
        return {spheres[link], others.empty() ? std::span<const Element>() : std::span<const Element>(others[link])};
    }
};

/// Why a pair is not checked, in the words of MoveIt's SRDFs.
enum class PairReason {
    none,         ///< it is checked
    adjacent,     ///< joined by at most one moving joint, without collision geometry in between
    always,       ///< touches in every configuration
    default_pose, ///< touches in the reference pose
    never,        ///< touches in no configuration
};

/// Returns "Adjacent", "Always", "Default", "Never"; "" for none.
const char* to_string(PairReason reason);

/// Two links with elements.
struct LinkPair {
    std::size_t first = 0, second = 0; ///< indices into robot.links, first < second
    PairReason reason = PairReason::none;
    bool proved = false; ///< always, never: for all configurations within the limits
    /// Random configurations that were tested, and those in which the pair touched; none for a pair that is adjacent or
    /// proved.
    std::size_t samples = 0, touching = 0;
    /// Whether a planar or floating joint lies in between: the relative pose of the links is then unknown.
    bool unbounded = false;
};

struct SelfCollisionOptions {
    std::size_t samples = 100000;
    double confidence = 0.95; ///< above 0, below 1
    std::uint64_t seed = 0;
    /// A proof gives up after this number of boxes of joint values, for one pair; 0: no proofs.
    std::size_t proof_boxes = 20000;
    JointValues reference{}; ///< of the reference pose; unnamed joints are at zero, moved into their limits
    const std::atomic<bool>* cancel = nullptr;
};

struct SelfCollisionMatrix {
    std::vector<LinkPair> pairs; ///< all pairs of links with elements, in the order of the links
    std::vector<double> reference;
    std::size_t samples = 0;
    double confidence = 0;

    /// Returns the bound on the rate of touching: with the stated confidence, a pair that touched in no sample touches
    /// in less than this share of all configurations: 1 - (1 - c)^(1/n), about 3/n at 95 % (the rule of three). The
    /// same bound applies to staying apart.
    double rate_bound() const;
    /// Returns the bound that applies, with the stated confidence, to all such pairs at once (Bonferroni).
    double joint_rate_bound() const;
    std::size_t count(PairReason reason) const;
};

/// Computes the matrix. Configurations are uniform within the limits. Equal seeds give equal matrices on any number of
/// threads. Throws Error(usage) for a reference that the robot cannot take, Error(cancelled).
SelfCollisionMatrix self_collision_matrix(const Kinematics& kinematics, const CollisionModel& model,
                                          const SelfCollisionOptions& options = {});

/// Returns the pairs that need no check, in the order of the links.
std::vector<IgnoredPair> ignored_pairs(const Robot& robot, const SelfCollisionMatrix& matrix);
/// Returns a <robot> with a <disable_collisions> for each pair that is not checked, as MoveIt reads it.
std::string srdf_text(const Robot& robot, const SelfCollisionMatrix& matrix);
/// Returns the `self_collision_ignore` of cuRobo's robot files (YAML): each link, with the later links that it is not
/// checked against.
std::string curobo_text(const Robot& robot, const SelfCollisionMatrix& matrix);

} // namespace collision
} // namespace foam
