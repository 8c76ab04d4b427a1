// A robot twice, body by body: its collision geometry as the URDF gives it, and spheres.
#pragma once

#include "engine.hpp"

#include <foam/judge/evaluate.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/model.hpp>

#include <memory>
#include <vector>

namespace foam::inline bench {

struct TwoModels {
    std::shared_ptr<const Kinematics> kinematics;
    std::vector<std::size_t> links; ///< of each body, its index in the robot's links
    EngineRobot original, spheres;  ///< the same pairs
    std::size_t ignored_pairs = 0;  ///< of all pairs of bodies
};

/// Returns the elements of a file for the links of the robot; links without elements are left out. Throws Error as
/// read_sphere_file() does.
std::vector<LinkSpheres> matched_elements(const Original& original, const std::filesystem::path& file,
                                          const Registry& registry);

/// Returns both models. Links that there are no spheres for are left out of both. `seed`: of the samples that choose
/// the pairs. Throws Error(usage) for other elements than spheres.
TwoModels two_models(const Original& original, const std::vector<LinkSpheres>& spheres, std::uint64_t seed);

} // namespace foam::inline bench
