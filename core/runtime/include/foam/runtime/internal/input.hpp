// Input: what a recipe names, and the geometry that is prepared of it.
#pragma once

#include <foam/runtime/internal/reading.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    std::vector<InputFile> further;     ///< Robot::further_files, by their paths from its folder
    StageReport report;                 ///< of the loader; its stage is empty for a single mesh
};

/// Returns how the recipe's input is read. The recipe must outlive it.
Reading reading_of(const Workspace& workspace);

/// Returns RunOptions::input, or loads the first candidate that resolves. Throws Error(input) with every place tried, or with the error in the file.
Input load_input(const Workspace& workspace);
/// Returns whether a candidate resolves.
bool input_resolves(const Recipe& recipe);

/// A link that is to be spherized.
struct LinkWork : LoadedLink {
    Recipe::LinkRecipe recipe;
    LinkReport report;
    bool bounds_only = false; ///< the figures of the report are bounds: there was no time to measure
};

/// The destination of a task's result: element `element` of link `link`.
struct Target {
    std::size_t link, element;
};

/// A chain of filters on a mesh, run once for all elements that share it.
struct FilterTask {
    std::shared_ptr<const Mesh> mesh;
    std::vector<StageCall> filters;
    Digest digest;
    std::vector<Target> targets;
    std::vector<std::shared_ptr<const Mesh>> results;
    std::vector<StageReport> reports;
    std::optional<Error> error;
};

/// Returns the links with their meshes loaded, but for those that the recipe skips. Errors as in prepare_links().
std::vector<LinkWork> load_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files);
/// Returns the distinct chains of filters that loaded links need. Sets the digests of the elements.
std::vector<FilterTask> filter_tasks(const Workspace& workspace, std::vector<LinkWork>& links);
/// Returns the cache key of a filter's result on a mesh. `content`: the mesh's digest.
Digest filter_key(const Workspace& workspace, const StageCall& filter, const Mesh& mesh, const Digest& content);

/// Runs the chains of filters on loaded links. Keeps errors with the links.
void filter_links(const Workspace& workspace, std::vector<LinkWork>& links);

/// Runs load_links() and filter_links(). Returns one entry for every link with collision geometry, in the robot's
/// order. Errors are kept in the entry, except cancellation, which is thrown. `files`: the mesh files that were read.
std::vector<LinkWork> prepare_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files);

/// Returns the mesh files that prepare_links() would read, without loading them; leaves out those that cannot be read.
std::vector<InputFile> mesh_files(const Workspace& workspace, const Robot& robot);

} // namespace gnu::visibility("default")]]runtime

} // namespace foam
