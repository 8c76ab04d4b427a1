// The input: from the recipe's candidates to a robot.
#pragma once

#include <foam/runtime/internal/reading.hpp>

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

/// Returns how the recipe's input is read. The recipe must outlive it.
Reading reading_of(const Workspace& workspace);

/// Returns RunOptions::input, or loads the first candidate that resolves. Throws Error(input) with every place tried,
/// or with the error in the file.
Input load_input(const Workspace& workspace);
/// Returns whether a candidate resolves.
bool input_resolves(const Recipe& recipe);

} // namespace runtime
} // namespace foam
