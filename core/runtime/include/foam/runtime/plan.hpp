// The plan of a run: its inputs are found and read, nothing is computed or written.
#pragma once

#include <foam/runtime/run.hpp>

#include <map>
#include <optional>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// A stage as a run would call it.
struct PlannedStage {
    std::string stage, plugin, plugin_version;
    std::map<std::string, ParameterValue> given; ///< parameters whose values differ from their defaults
    /// Results in the cache, out of those needed. Under a robot-wide budget, later requests to a spherizer depend on
    /// its first results; only the first ones count here.
    std::size_t cached = 0, needed = 0;
};

struct PlannedLink {
    std::string link;
    std::vector<std::string> geometry;   ///< of each collision element: the mesh as written, or the primitive's kind
    std::vector<LinkOverride> overrides; ///< those of the recipe that apply to the link, in their order
    bool skipped = false;
    std::vector<PlannedStage> stages; ///< filters, then the spherizer; none if it is skipped or has an error
    std::string error;                ///< why its geometry cannot be read
};

struct PlannedOutput {
    PlannedStage writer;
    std::string file; ///< relative to the run directory
};

struct PlannedFile {
    std::filesystem::path file;
    std::string digest;
    std::string loader{}; ///< of a mesh: the stage that reads it
};

struct Plan {
    std::string input; ///< the candidate that is used, as written
    PlannedFile input_file;
    std::vector<std::string> not_found; ///< the candidates before it
    std::vector<PlannedFile> meshes;
    std::vector<PlannedStage> stages; ///< of the recipe, without overrides
    std::vector<PlannedLink> links;   ///< those with collision geometry
    std::vector<PlannedOutput> outputs;
    std::optional<PlannedStage> renderer; ///< absent: no pictures
    std::vector<Diagnostic> warnings;     ///< names of the recipe that match nothing in the robot
};

/// Throws Error as run() does if there is no input or it cannot be read; errors of single links are stored with them.
Plan plan(const Recipe& recipe, const Registry& registry, const RunOptions& options = {});

/// Returns the names of links and joints in the recipe that the robot does not have, found without reading meshes.
/// Empty if the recipe has no such names, or none of its inputs resolves. Throws Error as run() does if the robot
/// cannot be read.
std::vector<Diagnostic> unknown_names(const Recipe& recipe, const Registry& registry);
/// Adds the findings of unknown_names() for all runs of a recipe, each once: points of a sweep share most of them.
void add_unknown_names(RecipeResult& read, const Registry& registry);

} // namespace runtime
} // namespace foam
