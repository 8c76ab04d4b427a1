// Output for people: the mesh after every stage, and pictures.
#pragma once

#include <foam/runtime/internal/links.hpp>
#include <foam/runtime/internal/output.hpp>
#include <foam/runtime/internal/run_directory.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Writes links/<link>/<nn>-<stage>.ply if the recipe requests them: the link after each stage, link frame; spheres as
/// closed meshes. Returns the files. Warns where there is no time for all; write_snapshots() too.
std::vector<OutputFile> write_debug_meshes(const Workspace& workspace, const FinishedModel& finished,
                                           const RunDirectory& directory);

struct Snapshots {
    std::vector<std::filesystem::path> files; ///< relative to the run directory
    std::string robot;                        ///< PNG of the whole robot; empty if the recipe requests none
};

/// Returns the reason why a run leaves out output that is for people only.
std::string why_dropped(const Workspace& workspace);

/// Writes snapshots/robot.png (recipe: snapshots), and spheres.png and stages.png of links/<link> (recipe:
/// debug.snapshots).
Snapshots write_snapshots(const Workspace& workspace, const FinishedModel& finished, const RunDirectory& directory);

/// Returns the link after filter `stage` (0: as loaded), all elements in one mesh, link frame.
Mesh link_mesh(const LinkWork& link, std::size_t stage);

/// Returns a link's name as a folder name: every character but letters, digits, '-', '_' and '.' is replaced; a long
/// name is cut and ends with its digest. Different names stay different.
std::string folder_name(const std::string& link);

/// Returns the mesh as binary little-endian PLY.
std::string to_ply(const Mesh& mesh);

} // namespace runtime
} // namespace foam
