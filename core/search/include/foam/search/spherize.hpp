// Covering spheres, and spheres inside: cover() for spheres alone.
#pragma once

#include <foam/geometry/objective.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/search/cover.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// Spheres that cover a solid, with the proof: a Cover of spheres alone.
struct SphereCover {
    std::vector<Sphere> spheres; ///< m, in the solid's frame; at least one
    Certificate certificate;     ///< proof that solid.surface() lies in their union; it always holds
    double volume = 0;           ///< of their union, m³
};

/// Returns at most `count` spheres (at least 1) that cover the whole surface of the solid and are good by the
/// objective. By that objective they are never worse than those for Objective::excess. With Effort::fast the search
/// covers only this count, for callers that need one result now; otherwise the result is that of spherize_each(). The
/// result is the same on any number of threads. Throws Error(geometry) where Solid::make does, Error(usage) for a count
/// of 0. `options.kinds` does not matter here.
SphereCover spherize(const Solid& solid, std::size_t count, const CoverOptions& options = {});
/// Returns the same for a mesh: metres, any frame.
SphereCover spherize(const Mesh& mesh, std::size_t count, const CoverOptions& options = {});
/// Returns the covering spheres for each count, which do not depend on the other counts. Along the counts 1 to 8, 10,
/// 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64 (with Effort::fast and Objective::excess: 1 to 8, 16, 32, 64) more spheres
/// are never worse by the objective (never have more excess volume, protrude farther or have a larger largest radius).
/// Any other count is no worse than the nearest of these below it.
std::vector<SphereCover> spherize_each(const Solid& solid, std::span<const std::size_t> counts,
                                 const CoverOptions& options = {});

/// Returns at most `count` spheres inside the solid, proved (certify_inner() holds), that contain as much of its volume
/// as the search finds: balls are chosen one after another, then moved. Twice as many never contain less. None if no
/// ball fits. `stop` as in CoverOptions. Deterministic, on one thread. Throws Error(geometry) where inner_radii()
/// does.
std::vector<Sphere> spheres_inside(const Solid& solid, std::size_t count, const std::function<bool()>& stop = {});

} // namespace search
} // namespace foam
