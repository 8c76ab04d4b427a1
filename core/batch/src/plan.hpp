// What a folder of results is of: recipe, meshes, shards.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/batch/batch.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace foam::inline batch {

/// The work of a folder of results. It is written once, and the same in every process that works on the folder.
struct Plan {
    std::filesystem::path folder;
    std::string recipe;   ///< YAML, with paths as written
    Digest recipe_digest; ///< of the recipe and of foam's version
    std::size_t shards = 1;
    std::vector<BatchItem> items; ///< in the order of the work: large files first
    /// Where groups of items begin, and the end: a group has the scales of one mesh. Group i belongs to shard i modulo
    /// the number of shards, so that neighbours in a list, which are alike, and large meshes spread.
    std::vector<std::size_t> groups;

    /// Returns the items of a shard in the order of the work.
    std::vector<const BatchItem*> items_of(std::size_t shard) const;
    /// Returns the items that differ from an item of `items` in nothing but id and scale, with itself.
    std::span<const BatchItem> group_of(const BatchItem& item) const;
    /// Returns whether that group has different scales.
    bool has_scales(const BatchItem& item) const;
    /// Returns whether every shard is finished.
    bool complete() const;
    /// Returns the file of a finished shard.
    std::filesystem::path shard_file(std::size_t shard) const;
};

/// Returns the file of a shard's results while they are not complete.
std::filesystem::path part_of(const std::filesystem::path& shard_file);

/// Opens the folder for this work, or makes it. Several processes may do so at the same time. `shards`: absent: as in
/// the folder, or one for every thousand meshes. Throws Error(usage) if the folder is of another recipe, list, number
/// of shards or version of foam. `recipe`: YAML with paths as written, so that the folder can move.
Plan open_plan(const std::filesystem::path& folder, const std::string& recipe, std::vector<BatchItem> items,
               std::optional<std::size_t> shards);

/// Reads the plan of a folder. Throws Error(input) if it has none.
Plan read_plan(const std::filesystem::path& folder);

inline constexpr std::size_t default_memory_limit = 4096; ///< MiB; of one worker

/// Opens or makes the plan. Throws Error(usage) for the recipe of a robot, and for one whose stage makes other
/// elements than spheres.
Plan plan_for(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options);

/// Returns the recipe as workers get it: YAML with absolute paths.
std::string worker_recipe(const Recipe& recipe, const Registry& registry);

} // namespace foam::inline batch
