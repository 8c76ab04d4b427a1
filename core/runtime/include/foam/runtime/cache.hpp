// The cache folder of stage results: its size and its trimming.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

struct CacheContents {
    std::size_t entries = 0;
    std::uintmax_t bytes = 0;
};

/// Returns $XDG_CACHE_HOME/foam or ~/.cache/foam; empty if neither is known.
std::filesystem::path default_cache_folder();

/// Returns the most bytes that a run leaves in the cache: FOAM_CACHE_LIMIT in MiB, 2048 MiB without it; 0 means no
/// limit. Throws Error(usage) if the variable is not a whole number.
std::uintmax_t cache_limit();

/// Returns the number and size of the entries; other files in the folder are neither counted nor touched. O(n) for n
/// entries.
CacheContents cache_contents(const std::filesystem::path& folder);

/// Deletes entries until at most `bytes` remain, the least recently used first. Returns what it deleted. Runs may use
/// the cache meanwhile. O(n log n).
CacheContents trim_cache(const std::filesystem::path& folder, std::uintmax_t bytes);

/// Removes the unfinished folders that killed runs of this user left in the folder for temporary files and in `folders`;
/// those of running ones stay. Returns how many it removed.
std::size_t remove_leftovers(const std::vector<std::filesystem::path>& folders);

} // namespace runtime
} // namespace foam
