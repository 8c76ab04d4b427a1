// Geometry in memory to spheres in memory, without recipe, files or plugins.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/objective.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// How long spherize() searches for better spheres. docs/guide/spherizers.md has the time of each.
enum class Effort { fast, normal, best };

struct SpherizeOptions {
    Effort effort = Effort::normal;
    Objective objective = Objective::excess;
    std::uint64_t seed = 0;
    /// Called now and then in the calling thread; true ends the search with the best spheres so far, which still cover
    /// and are certified.
    /// Results are the same from run to run only if it never returns true.
    std::function<bool()> stop{};
};

/// Spheres that cover a solid, with the proof.
struct Cover {
    std::vector<Sphere> spheres; ///< m, in the solid's frame; at least one
    Certificate certificate;     ///< proof that solid.surface() lies in their union; it always holds
    double volume = 0;           ///< of their union, m³
};

/// The search for covering spheres of one solid, with one sphere, two, three…. Each result builds on those with fewer
/// spheres, and all results are kept for later calls. Not for several threads at once; it uses all cores itself.
class CoverSearch {
public:
    /// Starts a search. The solid must outlive it.
    CoverSearch(const Solid& solid, const SpherizeOptions& options);
    ~CoverSearch();
    CoverSearch(const CoverSearch&) = delete;
    CoverSearch& operator=(const CoverSearch&) = delete;

    /// Returns the same as spherize_each(), whatever was requested before. Throws Error(usage) for a count of 0.
    /// Exceptions of `stop` pass through; the search remains usable.
    Cover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Returns at most `count` spheres (at least 1) that cover the whole surface of the solid and are good by the
/// objective. By that objective they are never worse than those for Objective::excess. With Effort::fast the search
/// covers only this count, for callers that need one result now; otherwise the result is that of spherize_each(). The
/// result is the same on any number of threads. Throws Error(geometry) where Solid::make does, Error(usage) for a count
/// of 0.
Cover spherize(const Solid& solid, std::size_t count, const SpherizeOptions& options = {});
/// Returns the same for a mesh: metres, any frame.
Cover spherize(const Mesh& mesh, std::size_t count, const SpherizeOptions& options = {});
/// Returns the covering spheres for each count, which do not depend on the other counts. Along the counts 1 to 8, 10,
/// 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64 (with Effort::fast and Objective::excess: 1 to 8, 16, 32, 64) more spheres
/// are never worse by the objective (never have more excess volume, protrude farther or have a larger largest radius).
/// Any other count is no worse than the nearest of these below it.
std::vector<Cover> spherize_each(const Solid& solid, std::span<const std::size_t> counts,
                                 const SpherizeOptions& options = {});

/// Returns at most `count` spheres inside the solid, proved (certify_inner() holds), that contain as much of its volume
/// as the search finds: balls are chosen one after another, then moved. Twice as many never contain less. None if no
/// ball fits. `stop` as in SpherizeOptions. Deterministic, on one thread. Throws Error(geometry) where inner_radii()
/// does.
std::vector<Sphere> spheres_inside(const Solid& solid, std::size_t count, const std::function<bool()>& stop = {});

} // namespace search
} // namespace foam
