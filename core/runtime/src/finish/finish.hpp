// What finishes the result of the search, and what is reported of it.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/links.hpp>

#include <vector>

namespace foam::inline runtime {

/// Returns whether enclosing spheres may take the place of a result that the time limit has left unfinished: the links
/// are loaded, each can have one, and the recipe allows for so many spheres.
bool may_be_enclosed(const Workspace& workspace, const std::vector<LinkWork>& links);

/// Returns a group for each link without an error, with its smallest enclosing sphere and nothing that takes long. Adds
/// to the journal that they stand in for others.
std::vector<Group> enclosed_groups(const Workspace& workspace, std::vector<LinkWork>& links);

/// Sets Group::uncovered of the groups whose links keep spheres. Removes from `groups` those that need no other sphere,
/// and returns them. Errors go to the links, whose groups are removed.
std::vector<Group> take_covered_groups(const Workspace& workspace, std::vector<LinkWork>& links,
                                       std::vector<Group>& groups);

/// Returns the number of spheres that the groups keep.
std::size_t kept_spheres(const std::vector<LinkWork>& links, const std::vector<Group>& groups);

/// Returns the tree with the kept spheres in front of each level.
SphereTree with_kept(const std::vector<Sphere>& kept, SphereTree tree);

/// Returns how far single precision may move a sphere's surface: half a unit in the last place of each coordinate and
/// of the radius, twice that to be safe.
double float32_slack(const Sphere& sphere, Numbers numbers);

/// Returns an element of the same kind, with lengths on the grid, that contains the element. Vertices of a hull move to
/// the grid in the link's frame, which becomes its own.
Element up_on_grid(Element element, const DecimalGrid& grid);

/// Grows elements until they are proved to cover as they are, by 4095 steps of the grid at most. Elements that cover may
/// not be proved to once their lengths are rounded up: where they only just overlap, pieces of the surface become too
/// small for a proof. Hulls are proved twice: as they are, and as files of meshes have them (float32_hull()).
void grow_until_proved(const Solid& solid, Elements& elements, const DecimalGrid& grid);

/// Moves the elements of a level that has not only spheres onto the grid, grows them to cover if they are to be `outer`,
/// and rounds their lengths up. Returns the largest growth of a length, m.
double finish_elements(const Solid& solid, Elements& elements, const DecimalGrid& grid, bool outer,
                       Numbers numbers);

/// Tells of links whose material fills little of their box and is thin, unless the recipe fills them: their figures are
/// relative to little volume.
void tell_hollow_links(const Workspace& workspace, const FinishedModel& finished);

/// Warns of small links that the allocation gave few spheres with much excess, such as fingers, while other links got
/// many.
void tell_loose_links(const Workspace& workspace, const FinishedModel& finished);

/// Sets LinkReport::visual_gap of the links with spheres and visual geometry, or why it is not known. Does nothing if
/// the spheres cover the visual geometry anyway. The gap is an upper bound within 0.1 %, by certify().
void measure_visual_gaps(const Workspace& workspace, const FinishedModel& finished, std::vector<LinkWork>& links);

} // namespace foam::inline runtime
