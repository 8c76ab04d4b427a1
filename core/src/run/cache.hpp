// Results of stages on disk, found by what they were made from. Anything in the folder may be deleted at any time.
#pragma once

#include "digest.hpp"
#include "journal.hpp"

#include <foam/mesh.hpp>
#include <foam/sphere.hpp>

#include <atomic>
#include <filesystem>
#include <optional>

namespace foam {

template <class T> struct Cached {
    T result;
    StageLog said; ///< when it was made; of the findings severity and message
};

class Cache {
public:
    /// An empty folder name switches the cache off.
    explicit Cache(std::filesystem::path folder);

    /// Absent: not there, or damaged (a damaged entry counts as not there).
    std::optional<Cached<Mesh>> mesh(const Digest& key) const;
    std::optional<Cached<SphereTree>> tree(const Digest& key) const;
    /// Failures to write are not errors: the entry is then not there the next time.
    void put(const Digest& key, const Mesh& mesh, const StageLog& said) const;
    void put(const Digest& key, const SphereTree& tree, const StageLog& said) const;

    /// trim_cache() if something was put; 0: no limit.
    void keep_within(std::uintmax_t bytes) const;

    /// $XDG_CACHE_HOME/foam or ~/.cache/foam; empty if neither is known.
    static std::filesystem::path default_folder();

private:
    std::filesystem::path file(const Digest& key) const;
    std::optional<std::string> load(const Digest& key) const;
    void store(const Digest& key, std::string payload) const;
    std::filesystem::path folder_;
    mutable std::atomic<bool> grew_{false};
};

} // namespace foam
