// The inputs of a recipe on this machine, without loading a mesh.
#pragma once

#include "record/record.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam::inline runtime {

struct InputsHere {
    std::vector<Checkpoint> digests; ///< as in Record::inputs
    std::map<std::string, std::filesystem::path> files;
};

/// Returns the robot or mesh file and the mesh files of its links, without those that cannot be read. Throws Error for
/// a robot that is not found or cannot be loaded.
InputsHere inputs_here(const Recipe& recipe, const Registry& registry);

} // namespace foam::runtime
