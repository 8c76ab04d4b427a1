// The tree of bodies as links and joints.
#pragma once

#include "geoms.hpp"
#include "model.hpp"

#include <foam/robot/robot.hpp>

#include <string>
#include <vector>

namespace foam::mjcf {

/// The tree of a model: a robot without geometry, and the geoms of its links.
struct Tree {
    Robot robot;
    std::vector<Geom> geoms; ///< in the order of MuJoCo's
};

/// Returns the tree. The root link is "world"; a body has the frame of its link. Bodies and joints without a name are
/// called by their number in MuJoCo, such as "body_3". Throws Error(input) naming file and line.
Tree tree_of(const Model& model);

} // namespace foam::mjcf
