// What a run writes: its folder, outputs, and pictures.
#pragma once

#include <foam/runtime/internal/links.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Marks a folder as unfinished for its lifetime. A crash of the process removes it (remove_unfinished_runs()). Where the
/// process is killed, remove_abandoned_folders() of a later one does.
class UnfinishedFolder {
public:
    /// Precondition: the folder exists, and is the caller's own.
    explicit UnfinishedFolder(const std::filesystem::path& folder);
    ~UnfinishedFolder();
    UnfinishedFolder(const UnfinishedFolder&) = delete;
    UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

    /// Removes the mark, before the folder gets its final name.
    void finish();

private:
    std::filesystem::path mark_;
    int slot_ = -1, lock_ = -1;
};

/// The file that marks an unfinished folder.
inline constexpr const char* unfinished_mark = ".foam-unfinished";

/// Removes the unfinished folders directly below `parent` that killed processes of this user left behind. Those of
/// running processes are locked, and stay. Returns how many are removed.
std::size_t remove_abandoned_folders(const std::filesystem::path& parent);

// The folder of a run: filled under a temporary name, then put in place in one step. An interrupted run keeps the
// previous one.

class RunDirectory {
public:
    /// Makes the temporary folder beside `target`, and removes those that killed runs left there. Throws Error(output)
    /// naming the file if `target` holds anything that the run before did not write: each run leaves the list `.foam-run`
    /// of its files.
    explicit RunDirectory(std::filesystem::path target);
    /// Removes the temporary folder if commit() was not called.
    ~RunDirectory();
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;

    /// `file` is relative to the folder.
    void write(const std::filesystem::path& file, std::string_view bytes) const;
    /// Puts the folder in place of that of an earlier run. Throws Error(output) if a file of others came there meanwhile.
    void commit();
    /// Returns the final absolute path.
    const std::filesystem::path& target() const { return target_; }

private:
    std::filesystem::path target_, temporary_;
    std::optional<UnfinishedFolder> unfinished_; ///< removed after a crash, too
    bool committed_ = false;
};

struct OutputFile {
    std::string stage; ///< the writer; empty for a debug mesh
    std::string file;  ///< relative to the run directory
    Digest digest;
    std::size_t bytes = 0;
    std::vector<WrittenProof> proofs = {}; ///< of the links whose guarantee is proved
    /// Digest of the writer's output without a folder, if that differs: the same for every place of the run directory.
    Digest portable_digest = {};
};

/// Returns the file that an output edits; nothing for an output that writes a whole file.
std::optional<TextFile> into_of(const Workspace& workspace, const OutputCall& output);

/// Writes every output of the recipe, reads it back as another program would, compares the spheres and runs the
/// certificate on the numbers read. Throws Error(internal) if a proof that held in memory does not hold on the file.
std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory);

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
