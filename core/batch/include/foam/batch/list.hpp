// Lists of meshes.
#pragma once

#include <foam/recipe/mesh_unit.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] batch {

/// One mesh of a data set.
struct BatchItem {
    std::string id;   ///< unique in the list
    std::string path; ///< absolute; "FILE.zip::MEMBER" and "FILE.tar::MEMBER" lie in archives
    MeshUnit unit;
    std::optional<std::size_t> spheres; ///< instead of the recipe's budget
    std::uintmax_t bytes = 0;           ///< size of the file; 0: not known, or there is no such file
};

/// Returns the meshes of a data set, sorted by id; `bytes` is 0. `source` is one of
/// - a list: JSON lines (.jsonl) with the keys id, path, scale, unit and spheres; a table (.csv) with these columns in
///   its first line; or a text (.txt) with one path a line. Only `path` is required; the id is the path otherwise.
///   Paths are relative to the list's folder;
/// - a folder or an archive (.zip, .tar): all its files that a loader of the registry reads; ids are their paths in it.
///   Links are followed, but to a folder that contains the link;
/// - a glob ("meshes/*.obj"), in which * and ? stay within a folder;
/// - "-": JSON lines from the standard input, with paths relative to the current folder.
/// Throws Error(input) that names the file and line, also for an id that occurs twice and for an empty list.
std::vector<BatchItem> read_batch_list(const std::string& source, const Registry& registry);

} // namespace batch
} // namespace foam
