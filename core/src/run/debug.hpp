// What a person looks at: the mesh after every stage, and pictures.
#pragma once

#include "links.hpp"
#include "output.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace foam {

/// links/<link>/<nn>-<stage>.ply, if the recipe wants them: the link after each stage, link frame; spheres as closed
/// meshes. Returns the files. Where there is no time for all a warning says so; the same of pictures.
std::vector<OutputFile> write_debug_meshes(const Workspace& workspace, const FinishedModel& finished,
                                           const RunDirectory& directory);

struct Snapshots {
    std::vector<std::filesystem::path> files; ///< relative to the run directory
    std::string robot;                        ///< PNG of the whole robot; empty if the recipe wants none
};

/// Why what is for people alone is left out of a run.
std::string why_dropped(const Workspace& workspace);

/// snapshots/robot.png and links/<link>/spheres.png (recipe: snapshots), links/<link>/stages.png (recipe:
/// debug.snapshots).
Snapshots write_snapshots(const Workspace& workspace, const FinishedModel& finished, const RunDirectory& directory);

/// The link after filter `stage` (0: as loaded), all elements in one mesh, link frame.
Mesh link_mesh(const LinkWork& link, std::size_t stage);

/// Returns a link's name as a folder name: all but letters, digits, '-', '_' and '.' replaced, a long one cut and ended
/// by its digest. Different names stay different.
std::string folder_name(const std::string& link);

/// Binary little-endian PLY.
std::string to_ply(const Mesh& mesh);

} // namespace foam
