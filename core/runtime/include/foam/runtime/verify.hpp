// Verification of a run directory: a second run with this foam must give the same results from the same inputs.
#pragma once

#include <foam/runtime/run.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// A difference from the manifest.
struct Difference {
    std::string link;  ///< empty: the whole run
    std::string stage; ///< "smooth.humphrey", "cover", "input file", "setting", "file in the run directory", …
    std::string input; ///< its input: a mesh, a file, the path of a setting
    std::string expected, found;
    std::string place() const; ///< "link 'hand', stage 'smooth.humphrey', input 'hand.stl'"
};

struct Verification {
    std::vector<Difference> differences; ///< in the order of the work: the first is where the runs diverge
    std::vector<std::string> reasons;    ///< inputs in other places, versions and builds other than the manifest's
    std::size_t compared = 0;            ///< digests
    bool equal() const { return differences.empty(); }
};

/// Runs `directory`/recipe.resolved.yaml again, never from the cache, and compares every digest of the manifest with
/// the result: settings, inputs, every stage of every link, outputs, debug meshes; then the files in the directory.
/// Pictures are not compared. Of `options` it uses threads, cancel, observer and program. Throws Error(usage) if it is
/// not a run directory or its manifest is damaged, Error(plugin) if a plugin that the run needs is missing.
Verification verify(const std::filesystem::path& directory, Registry& registry, const RunOptions& options = {});

/// Checks a run against a manifest.
class Lock {
public:
    /// `manifest`: the file, or its run directory. Throws Error(usage).
    explicit Lock(const std::filesystem::path& manifest);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

    /// Returns the name of the run.
    std::string name() const;
    /// Returns the path of the recipe with every default, which a run directory has beside its manifest.
    std::filesystem::path resolved_recipe() const;
    /// Throws Error(plugin) with the plugins that are missing or of another version: the likely reason why a recipe
    /// cannot be read.
    void check_plugins(const Registry& registry) const;
    /// Throws Error with all differences that are known before the computation: versions, settings, inputs. Its code is
    /// plugin if only plugins differ, else usage.
    void check_start(const Recipe& recipe, const Registry& registry) const;
    /// Throws Error(output) if an output differs from the manifest's; for RunOptions::accept.
    void check_outputs(const std::string& manifest) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace runtime
} // namespace foam
