// Results of stages on disk, found by the digest of their inputs. The files may be deleted at any time.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/geometry/internal/digest.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/robot/robot.hpp>
#include <foam/runtime/internal/journal.hpp>

#include <atomic>
#include <filesystem>
#include <optional>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Adds links, their collision elements and joints; not the places of files, nor visual geometry.
void add_to(Hasher& hasher, const Robot& robot);
/// Adds what determines the effect of a stage: its name, its build and that of foam's libraries, its revision, and all
/// parameters that affect its output, defaults included.
void add_call(Hasher& hasher, const StageCall& call, const Registry& registry);

template <class T> struct Cached {
    T result;
    StageLog log; ///< the log of the call that made it; of findings severity and message
};

class Cache {
public:
    /// Opens the cache in `folder`. An empty name disables the cache.
    explicit Cache(std::filesystem::path folder);

    /// Returns the mesh, or nothing if the entry does not exist or is damaged.
    std::optional<Cached<Mesh>> mesh(const Digest& key) const;
    std::optional<Cached<SphereTree>> tree(const Digest& key) const;
    /// Stores the mesh. Failures to write are not errors: the entry is then missing next time.
    void put(const Digest& key, const Mesh& mesh, const StageLog& log) const;
    void put(const Digest& key, const SphereTree& tree, const StageLog& log) const;

    /// Calls trim_cache() if something was stored. `bytes` 0: no limit.
    void keep_within(std::uintmax_t bytes) const;

    /// Returns $XDG_CACHE_HOME/foam or ~/.cache/foam; empty if neither is known.
    static std::filesystem::path default_folder();

private:
    std::filesystem::path file(const Digest& key) const;
    std::optional<std::string> load(const Digest& key) const;
    void store(const Digest& key, std::string payload) const;
    std::filesystem::path folder_;
    mutable std::atomic<bool> grew_{false};
};

} // namespace runtime
} // namespace foam
