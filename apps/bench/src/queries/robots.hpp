// A robot twice, body by body: its collision geometry as the URDF gives it, and spheres.
#pragma once

#include <foam/bench/collision_engine.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/runtime/internal/workspace.hpp>

#include <memory>
#include <string>
#include <vector>

namespace foam::inline bench {

struct TwoModels {
    std::string input; ///< the candidate that was taken
    std::shared_ptr<const Kinematics> kinematics;
    std::vector<std::size_t> links; ///< of each body, its index in the robot's links
    EngineRobot original, spheres;  ///< the same pairs
    bool certified = false;         ///< the spheres hold the original, proved
    double excess = 0;              ///< of the spheres
    std::size_t ignored_pairs = 0;  ///< of all pairs of bodies
};

/// Runs the recipe's chain for the spheres, with its budget over the robot. Throws Error as run() does.
TwoModels with_made_spheres(const Workspace& workspace);
/// Takes the spheres of a file. Links that it has no spheres for are left out of both models.
TwoModels with_given_spheres(const Workspace& workspace, const std::filesystem::path& spheres);

} // namespace foam::bench
