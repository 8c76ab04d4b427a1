// From the recipe's candidates to a robot.
#pragma once

#include "workspace.hpp"

#include <foam/robot.hpp>

#include <memory>
#include <string>

namespace foam {

struct Input {
    std::string chosen; ///< the candidate, as written in the recipe
    std::filesystem::path file;
    std::shared_ptr<const Robot> robot; ///< a single mesh becomes a robot of one link
    Digest digest;                      ///< of the file
    std::size_t bytes = 0;              ///< of the file
    StageReport report;                 ///< of the loader; its stage is empty for a single mesh
};

/// The loader that reads a mesh file by its ending; null if none does.
const RegisteredStage* mesh_loader_of(const Workspace& workspace, const std::filesystem::path& file);
/// The bytes of a mesh file; of no more than its loader takes by its parameter max_bytes. Throws Error(input).
std::string read_mesh_file(const Workspace& workspace, const std::filesystem::path& file);

/// Takes the first candidate that resolves. Throws Error(input) naming every place tried, or what is wrong with the
/// file.
Input load_input(const Workspace& workspace);
/// Whether there is such a candidate.
bool input_resolves(const Recipe& recipe);

} // namespace foam
