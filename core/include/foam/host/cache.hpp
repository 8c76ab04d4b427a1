// The folder that keeps results of stages: how much it holds, and making it smaller.
#pragma once

#include <cstdint>
#include <filesystem>

namespace foam {

struct CacheContents {
    std::size_t entries = 0;
    std::uintmax_t bytes = 0;
};

/// $XDG_CACHE_HOME/foam or ~/.cache/foam; empty if neither is known.
std::filesystem::path default_cache_folder();

/// Bytes that a run leaves in the cache at most: FOAM_CACHE_LIMIT in MiB, 2048 MiB without it; 0 stands for any number.
/// Throws Error(usage) if the variable is no whole number.
std::uintmax_t cache_limit();

/// Entries only: other files that lie there are neither counted nor touched. O(n) for n entries.
CacheContents cache_contents(const std::filesystem::path& folder);

/// Deletes entries until at most `bytes` are left, those first that were not used for longest. Returns what it deleted.
/// Runs that use the cache meanwhile go on. O(n log n).
CacheContents trim_cache(const std::filesystem::path& folder, std::uintmax_t bytes);

} // namespace foam
