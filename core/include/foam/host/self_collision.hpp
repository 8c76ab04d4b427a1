// Which pairs of a robot's links never need a collision check: the self-collision matrix, as an SRDF's
// <disable_collisions> lists it, by proof where there is one and by samples with a stated confidence elsewhere.
#pragma once

#include <foam/host/evaluate.hpp>
#include <foam/host/kinematics.hpp>
#include <foam/sphere.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {

/// The spheres that stand for each link.
struct CollisionModel {
    /// Where the spheres of a link are from.
    enum class Source {
        none,  ///< the link has no collision geometry
        given, ///< they are the geometry, or a sphere file has them
        cover, ///< found here, certified to hold the link's geometry
    };
    std::shared_ptr<const Robot> robot;
    std::vector<std::vector<Sphere>> spheres; ///< of each link of the robot, in its frame; empty: never collides
    std::vector<Source> sources;              ///< of each link of the robot
    std::vector<std::string> notes;           ///< what the loaders warned of, and what is left out
};

/// Reads a URDF. Collision elements that are spheres stand for themselves; a link with any other geometry gets a
/// certified cover of at most `spheres_per_link` spheres. Throws Error(input) if the file or a mesh of it cannot be
/// read or if fewer than two links have collision geometry.
CollisionModel load_collision_model(const std::filesystem::path& urdf, const Registry& registry,
                                    std::size_t spheres_per_link);
/// The same with the spheres of a sphere file, brought onto the links as match() does.
CollisionModel load_collision_model(const std::filesystem::path& urdf, const std::filesystem::path& spheres,
                                    const Registry& registry, const Renames& renames = {});

/// Why a pair is not checked; the words of MoveIt's SRDFs.
enum class PairReason {
    none,         ///< it is checked
    adjacent,     ///< joined by at most one joint that moves, without collision geometry in between
    always,       ///< touches in every configuration
    default_pose, ///< touches in the reference configuration
    never,        ///< touches in no configuration
};

/// "Adjacent", "Always", "Default", "Never"; "" for none.
const char* to_string(PairReason reason);

/// Two links with spheres.
struct LinkPair {
    std::size_t first = 0, second = 0; ///< indices into robot.links, first < second
    PairReason reason = PairReason::none;
    bool proved = false; ///< always, never: for all configurations within the limits
    /// Random configurations that were looked at, and those in which the pair touched; none for a pair that is
    /// adjacent, or that something is proved of.
    std::size_t samples = 0, touching = 0;
    /// With a planar or floating joint in between: nothing is known of where the links may be to one another.
    bool unbounded = false;
};

struct SelfCollisionOptions {
    std::size_t samples = 100000;
    double confidence = 0.95; ///< above 0, below 1
    std::uint64_t seed = 0;
    /// A proof gives up after so many boxes of joint values, for one pair; 0: no proofs.
    std::size_t proof_boxes = 20000;
    JointValues reference{}; ///< of the reference configuration; joints that are not named are at zero, or at the limit
    const std::atomic<bool>* cancel = nullptr;
};

struct SelfCollisionMatrix {
    std::vector<LinkPair> pairs; ///< all of links with spheres, in the order of the links
    std::vector<double> reference;
    std::size_t samples = 0;
    double confidence = 0;

    /// With the stated confidence a pair that touched in none of the samples touches in less than this share of all
    /// configurations: 1 - (1 - c)^(1/n), about 3/n at 95 % (the rule of three). The same for staying apart.
    double rate_bound() const;
    /// What holds, with the stated confidence, of all such pairs at once (Bonferroni).
    double joint_rate_bound() const;
    std::size_t count(PairReason reason) const;
};

/// Configurations are uniform within the limits. Same seed, same matrix, on any number of threads. Throws Error(usage)
/// for a reference that the robot cannot take, Error(cancelled).
SelfCollisionMatrix self_collision_matrix(const Kinematics& kinematics, const CollisionModel& model,
                                          const SelfCollisionOptions& options = {});

/// <robot> with a <disable_collisions> for each pair that is not checked, as MoveIt reads it.
std::string srdf_text(const Robot& robot, const SelfCollisionMatrix& matrix);
/// `self_collision_ignore` of cuRobo's robot files (YAML): each link, with the later ones that it is not checked
/// against.
std::string curobo_text(const Robot& robot, const SelfCollisionMatrix& matrix);

} // namespace foam
