// The same run again: is what a run directory holds what this foam makes of the same inputs?
#pragma once

#include <foam/host/run.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace foam {

/// A thing that is not as the manifest says.
struct Difference {
    std::string link;  ///< empty: the whole run
    std::string stage; ///< "smooth.humphrey", "cover", "input file", "setting", "file in the run directory", …
    std::string input; ///< what it worked on: a mesh, a file, the path of a setting
    std::string expected, found;
    std::string place() const; ///< "link 'hand', stage 'smooth.humphrey', input 'hand.stl'"
};

struct Verification {
    std::vector<Difference> differences; ///< in the order of the work: the first is where it began
    std::vector<std::string> reasons;    ///< inputs in other places, versions and builds other than the manifest's
    std::size_t compared = 0;            ///< digests
    bool equal() const { return differences.empty(); }
};

/// Runs `directory`/recipe.resolved.yaml once more, never from the cache, and compares every digest of the manifest
/// with what comes out: settings, inputs, every stage of every link, outputs, debug meshes; then the files that lie in
/// the directory. Pictures are not compared. Of `options` threads, cancel, observer and program count. Throws
/// Error(usage) if it is not a run directory or its manifest is damaged, Error(plugin) if a plugin that the run needs
/// is not there.
Verification verify(const std::filesystem::path& directory, Registry& registry, const RunOptions& options = {});

/// Holds a run to a manifest.
class Lock {
public:
    /// `manifest`: the file, or the run directory that it lies in. Throws Error(usage).
    explicit Lock(const std::filesystem::path& manifest);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

    /// Name of the run.
    std::string name() const;
    /// The recipe with every default that a run directory holds beside its manifest.
    std::filesystem::path resolved_recipe() const;
    /// Throws Error(plugin) with the plugins that are missing or of another version: the likely reason for a recipe
    /// that cannot be read.
    void check_plugins(const Registry& registry) const;
    /// Throws Error with all that differs before anything is computed: versions, settings, inputs. Code plugin if only
    /// plugins differ, else usage.
    void check_start(const Recipe& recipe, const Registry& registry) const;
    /// For RunOptions::accept: throws Error(output) if an output is not the manifest's.
    void check_outputs(const std::string& manifest) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace foam
