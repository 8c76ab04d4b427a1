// Geometry in memory to capsules, cylinders, boxes, swept boxes, hulls or spheres in memory.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/search/spherize.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// What covering elements are to minimise.
enum class ApproximationObjective {
    excess,          ///< excess volume
    mean_protrusion, ///< area-weighted mean protrusion
    protrusion,      ///< largest protrusion
};

/// Returns the objective of a word: "mean_protrusion"; nothing for any other word.
std::optional<ApproximationObjective> approximation_objective_named(std::string_view word);

struct ApproximateOptions {
    Effort effort = Effort::normal;
    ApproximationObjective objective = ApproximationObjective::excess;
    /// Called now and then in the calling thread; true ends the search with the best elements so far, which still cover
    /// and are certified. Results are the same from run to run only if it never returns true.
    std::function<bool()> stop{};
    std::size_t max_vertices = 64; ///< of a hull, at least 4
    bool axis_aligned = false;     ///< boxes have the axes of the solid's frame
};

/// Convex elements that cover a solid, with the proof. Figures beside the volume: foam/geometry/measure.hpp.
struct ConvexCover {
    Elements elements; ///< m, in the solid's frame; at least one
    Certificate certificate;       ///< proof that solid.surface() lies in their union; it always holds
    double volume = 0;             ///< of their union, m³
};

/// The search for covering elements of one solid, with one element, two, three…. What the counts have in common is
/// computed once. Not for several threads at once; it uses all cores itself.
class ApproximationSearch {
public:
    /// Starts a search. The solid must outlive it. Throws Error(usage) without kinds or for fewer than 4 vertices,
    /// Error(geometry) for geometry without extent or out of bounds.
    ApproximationSearch(const Solid& solid, std::span<const Element::Kind> kinds, const ApproximateOptions& options);
    ~ApproximationSearch();
    ApproximationSearch(const ApproximationSearch&) = delete;
    ApproximationSearch& operator=(const ApproximationSearch&) = delete;

    /// Returns at most `count` elements, whatever was requested before. By the objective they are no worse than those
    /// for 1, 2, 4, 8, 16, 64, 256… elements, as far as these are fewer. Throws Error(usage) for a count of 0.
    ConvexCover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Returns at most `count` elements (at least 1) of the kinds that cover the whole surface of the solid and are good by
/// the objective. Of several kinds the best is chosen for each element. The result is the same on any number of
/// threads. Throws where ApproximationSearch does.
ConvexCover approximate(const Solid& solid, std::size_t count, std::span<const Element::Kind> kinds,
                        const ApproximateOptions& options = {});
/// Returns the same for a mesh: metres, any frame.
ConvexCover approximate(const Mesh& mesh, std::size_t count, std::span<const Element::Kind> kinds,
                        const ApproximateOptions& options = {});

/// Returns an element of the kind that contains the points (at least one; metres) and has the least volume that the
/// search finds; for a hull, the convex hull. Flat points get an element with a thickness of a millionth of their size.
/// O(n log n) and, of hull vertices, some hundred passes. `axis_aligned`: for boxes. Throws Error(geometry) without
/// points or for points that are not finite.
Element least_element(Element::Kind kind, std::span<const Vec3> points, Effort effort = Effort::normal,
                      bool axis_aligned = false);

/// An element with a bound on the volume of all elements of its kind around the same points.
struct ProvedElement {
    Element element;
    double volume = 0;      ///< m³
    double lower_bound = 0; ///< m³: no element of the kind that contains the points has less volume
    std::size_t cells = 0;  ///< cells of orientations that were examined
};

/// Returns an element whose volume exceeds that of the least one by at most the share `tolerance`, proved by branch and
/// bound over orientations: an element turned by an angle contains the points once it has grown by that angle times its
/// reach, which bounds the least volume over all orientations of a cell. Kinds: box, cylinder, capsule. Seconds for
/// 1e-3. The proof for capsules takes the least capsule along a direction from a convex problem in the plane that is
/// solved to 1e-7 of the size. Throws Error(usage) for another kind or a tolerance not above 0, Error(geometry) as
/// least_element(), and if a million cells are not enough.
ProvedElement proved_least(Element::Kind kind, std::span<const Vec3> points, double tolerance);

} // namespace search
} // namespace foam
