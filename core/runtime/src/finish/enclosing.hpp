// One enclosing sphere for each link, where there is no time for anything else.
#pragma once

#include <foam/runtime/internal/links.hpp>

namespace foam::inline runtime {

/// Returns whether enclosing spheres may take the place of a result that the time limit has left unfinished: the links
/// are loaded, each can have one, and the recipe allows for so many spheres.
bool may_be_enclosed(const Workspace& workspace, const std::vector<LinkWork>& links);

/// Returns a group for each link without an error, with its smallest enclosing sphere and nothing that takes long. Adds
/// to the journal that they stand in for others.
std::vector<Group> enclosed_groups(const Workspace& workspace, std::vector<LinkWork>& links);

} // namespace foam::inline runtime
