// Models of a robot by convex elements, and near pairs of their elements, as problems for collision engines.
#pragma once

#include "engine.hpp"

#include <foam/base/random.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/model.hpp>

#include <vector>

namespace foam::inline bench {

/// Returns the elements as libraries take them: a hull as a convex mesh, and so a swept box, which none of them knows.
EngineBody body_of(const Elements& elements);

/// The links of a robot with elements.
struct ElementRobot {
    std::vector<std::size_t> links; ///< of each body, its index in the robot's links
    EngineRobot robot;              ///< its pairs: all but those of neighbours
};
ElementRobot element_robot(const Kinematics& kinematics, const std::vector<LinkSpheres>& links);

/// Returns the number of pairs of shapes of two bodies of a pair.
std::size_t shape_pairs(const EngineRobot& robot);

/// `count` pairs of elements that are drawn from all of a model's. Each element is a body of its own, and a pair is
/// checked.
class NearPairs {
public:
    /// Precondition: there are elements.
    NearPairs(const std::vector<LinkSpheres>& links, std::size_t count, Random& random);
    const EngineRobot& robot() const { return robot_; }
    /// Returns poses in which the two elements of each pair do not touch, while their axis-aligned boxes, and the balls
    /// around these in the elements' own frames, overlap: what a broad phase leaves to be checked. Rotations are
    /// uniform.
    std::vector<Pose> poses(Random& random) const;

private:
    std::vector<Element> elements_; ///< by body, with its frame's origin at the centre
    EngineRobot robot_;
};

} // namespace foam::bench
