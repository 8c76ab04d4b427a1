// The self-collision matrix: the pairs of a robot's links that never need a collision check, as an SRDF's
// <disable_collisions> lists them. Pairs are proved where possible; elsewhere samples decide, with a stated confidence.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/robot/robot.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] collision {

/// The original geometry of each link of the robot, in its frame; null: it has none. Empty: not known.
using LinkSolids = std::vector<std::shared_ptr<const Solid>>;

/// Pairs of indices into robot.links, the smaller first.
using LinkPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// The elements of each link.
struct CollisionModel {
    /// The source of the elements of a link.
    enum class Source {
        none,     ///< the link has no collision geometry
        geometry, ///< they are the geometry
        given,    ///< from elsewhere; nothing is known of what they cover
        cover,    ///< certified to cover the link's geometry
    };
    std::shared_ptr<const Robot> robot;
    std::vector<Elements> elements; ///< of each link of the robot, in its frame; a link without any never collides
    std::vector<Source> sources;    ///< of each link of the robot
    std::vector<std::string> notes; ///< warnings of the loaders, and what is left out
    LinkSolids solids{};
};

/// Why a pair is not checked, in the words of MoveIt's SRDFs.
enum class PairReason {
    none,         ///< it is checked
    adjacent,     ///< joined by at most one moving joint, without collision geometry in between
    always,       ///< the original geometry touches in every configuration
    default_pose, ///< the original geometry touches in the reference pose, where SelfCollisionOptions::by_pose is set
    never,        ///< the elements touch in no configuration, or always and the original geometry in none
};

/// Returns "Adjacent", "Always", "Default", "Never"; "" for none.
const char* to_string(PairReason reason);

/// Two links with elements.
struct LinkPair {
    std::size_t first = 0, second = 0; ///< indices into robot.links, first < second
    PairReason reason = PairReason::none;
    bool proved = false; ///< always, never: for all configurations within the limits
    /// Random configurations that were tested, and those in which the elements touched; none for a pair that is
    /// adjacent or proved.
    std::size_t samples = 0, touching = 0;
    /// Of these, the configurations in which the original geometry was tested as well, and those in which it touched.
    /// It is tested where the elements touched in every sample, and where they may leave geometry out.
    std::size_t geometry_samples = 0, geometry_touching = 0;
    /// Whether the elements touch in no sample, but in a configuration that a search found: the pair is checked.
    bool found_touching = false;
    /// Whether the elements touch in every configuration that was tested, and the original geometry in some: the pair is
    /// checked, and a planner refuses every pose.
    bool touches_by_elements_alone = false;
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
    /// Also leaves out the pairs whose original geometry touches in the reference pose, as the MoveIt Setup Assistant
    /// does: contacts of such a pair in other poses are then missed.
    bool by_pose = false;
    const std::atomic<bool>* cancel = nullptr;
    /// Called with the share of the work that is done, 0 to 1, from any thread.
    std::function<void(double)> progress{};
};

struct SelfCollisionMatrix {
    std::vector<LinkPair> pairs; ///< all pairs of links with elements, in the order of the links
    std::vector<double> reference;
    std::size_t samples = 0;
    double confidence = 0;

    /// Returns the bound on the rate of touching: with the stated confidence, a pair that touched in no sample touches
    /// in less than this share of all configurations: 1 - (1 - c)^(1/n), about 3/n at 95 % (the rule of three). The
    /// same bound applies to staying apart, with the number of configurations in which the geometry was tested.
    /// Here of the pair with the fewest configurations.
    double rate_bound() const;
    /// Returns the bound of a pair that was tested in `tested` configurations.
    double rate_bound(std::size_t tested) const;
    /// Returns the bound that applies, with the stated confidence, to all such pairs at once (Bonferroni).
    double joint_rate_bound() const;
    std::size_t count(PairReason reason) const;
};

/// Computes the matrix. A pair is left out only if the links are adjacent, if they touch in no configuration, or if their
/// original geometry touches in every one: elements of a cover that touch are no reason. "In no configuration" is proved,
/// or neither samples nor a search for contact find one. Where the original geometry is not known
/// (CollisionModel::solids), no pair is left out because it touches. Configurations are uniform
/// within the limits. Equal seeds give equal matrices on any number of threads. Throws Error(usage) for a reference that
/// the robot cannot take, Error(cancelled).
SelfCollisionMatrix self_collision_matrix(const Kinematics& kinematics, const CollisionModel& model,
                                          const SelfCollisionOptions& options = {});

/// Returns a sentence about a pair that touches by its elements alone: in how many configurations, and what helps.
std::string sentence_about(const LinkPair& pair, const Robot& robot);
/// Returns the pairs that need no check, in the order of the links.
std::vector<IgnoredPair> ignored_pairs(const Robot& robot, const SelfCollisionMatrix& matrix);
/// Returns a <robot> with a <disable_collisions> for each pair that is not checked, as MoveIt reads it.
std::string srdf_text(const Robot& robot, const SelfCollisionMatrix& matrix);
/// Returns the `self_collision_ignore` of cuRobo's robot files (YAML): each link, with the later links that it is not
/// checked against.
std::string curobo_text(const Robot& robot, const SelfCollisionMatrix& matrix);

} // namespace collision
} // namespace foam
