// The input: from the recipe's candidates to a robot.
#pragma once

#include <foam/base/internal/files.hpp>
#include <foam/robot/robot.hpp>
#include <foam/runtime/internal/workspace.hpp>

#include <memory>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

struct Input {
    std::string chosen; ///< the candidate, as written in the recipe
    std::filesystem::path file;
    /// For a single mesh a robot with one link. With the geometry to be covered as its collision geometry.
    std::shared_ptr<const Robot> robot;
    std::vector<std::string> collision_only; ///< links that lose their collision geometry thereby
    Digest digest;                      ///< of the file
    std::size_t bytes = 0;              ///< of the file
    StageReport report;                 ///< of the loader; its stage is empty for a single mesh
};

/// Returns the loader for a mesh file by its extension; null if there is none.
const RegisteredStage* mesh_loader_of(const Workspace& workspace, const std::filesystem::path& file);
/// Returns the digest of a mesh file of at most as many bytes as its loader's parameter max_bytes allows. Throws
/// Error(input).
DigestedFile digest_of_mesh_file(const Workspace& workspace, const std::filesystem::path& file);

/// Loads the first candidate that resolves. Throws Error(input) with every place tried, or with the error in the file.
Input load_input(const Workspace& workspace);
/// Returns whether a candidate resolves.
bool input_resolves(const Recipe& recipe);

} // namespace runtime
} // namespace foam
