// Spheres that links keep (recipe: links: {…: {keep: …}}).
#pragma once

#include <foam/runtime/internal/spherize.hpp>

#include <vector>

namespace foam::inline runtime {

/// Sets Group::uncovered of the groups whose links keep spheres. Removes from `groups` those that need no other sphere,
/// and returns them. Errors go to the links, whose groups are removed.
std::vector<Group> take_covered_groups(const Workspace& workspace, std::vector<LinkWork>& links,
                                       std::vector<Group>& groups);

/// Returns the number of spheres that the groups keep.
std::size_t kept_spheres(const std::vector<LinkWork>& links, const std::vector<Group>& groups);

/// Returns the tree with the kept spheres in front of each level.
SphereTree with_kept(const std::vector<Sphere>& kept, SphereTree tree);

} // namespace foam::inline runtime
