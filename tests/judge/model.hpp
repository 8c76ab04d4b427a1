// The elements of a written file.
#pragma once

#include "body.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace judge {

struct Ball {
    Point center;
    Real radius = 0;
};

/// Elements by link: of a URDF, all its collision elements but those of the links `without`; of JSON as
/// schemas/spheres.schema.json has it; of a CSV with the columns link, x, y, z and radius. A mesh stands for its convex
/// hull. Throws std::runtime_error, also for a mesh that is not closed or not convex, since a reader that takes the
/// mesh as it is would check another body.
std::map<std::string, std::vector<Body>> read_elements(const std::filesystem::path& file,
                                                       const std::set<std::string>& without = {});

/// Likewise of a file that holds nothing but spheres. Throws std::runtime_error.
std::map<std::string, std::vector<Ball>> read_spheres(const std::filesystem::path& file,
                                                      const std::set<std::string>& without = {});

} // namespace judge
