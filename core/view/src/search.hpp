// Searches of a session: for a link, and for the whole robot.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/view/session.hpp>

#include <atomic>

namespace foam::inline view {

/// Returns the spheres of a link that a search keeps.
std::vector<Sphere> pinned_in(const LinkState& link);

/// Returns `kept` and others, `count` in all or fewer, that are proved to cover the solid, also in single precision.
/// The search ends with its best spheres after `seconds`, or when `cancel` becomes true. Throws Error(usage) if the
/// kept ones leave geometry uncovered and are as many as `count`.
std::vector<Sphere> searched_link(const Solid& solid, std::size_t count, const std::vector<Sphere>& kept,
                                  double seconds, const std::atomic<bool>& cancel);

/// Returns the spheres grown until they are proved to cover the solid.
std::vector<Sphere> closed_link(const Solid& solid, const std::vector<Sphere>& spheres);

/// Returns the recipe that keeps spheres of links: the pinned ones, or all of them with `everything`.
Recipe recipe_of(const ViewedRobot& robot, const SubjectOptions& options, Registry& registry, const ModelState& state,
                 std::optional<std::size_t> count, bool everything);

} // namespace foam::inline view
