// Geometry in memory to covering elements in memory, without recipe, files or plugins.
#pragma once

#include <foam/geometry/elements.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/objective.hpp>
#include <foam/geometry/solid.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// How long a search looks for better elements. docs/guide/spherizers.md has the time of each.
enum class Effort { fast, normal, best };
/// Returns the effort of a word: "fast"; nothing for any other word.
std::optional<Effort> effort_named(std::string_view word);

struct CoverOptions {
    /// The kinds of elements that may be used, at least one; of several the best is chosen for each element.
    std::vector<Element::Kind> kinds{Element::Kind::sphere};
    Effort effort = Effort::normal;
    Objective objective = Objective::excess; ///< `radius` is for spheres alone
    std::uint64_t seed = 0;                  ///< of the random starts of spheres; other kinds have none
    /// Called now and then in the calling thread; true ends the search with the best elements so far, which still cover
    /// and are certified. Results are the same from run to run only if it never returns true.
    std::function<bool()> stop{};
    std::size_t max_vertices = 64; ///< of a hull, at least 4
    bool axis_aligned = false;     ///< boxes have the axes of the solid's frame
};

/// Convex elements that cover a solid, with the proof. Figures beside the volume: foam/geometry/measure.hpp.
struct Cover {
    Elements elements;       ///< m, in the solid's frame; at least one
    Certificate certificate; ///< proof that solid.surface() lies in their union; it always holds
    double volume = 0;       ///< of their union, m³
};

/// The search for covering elements of one solid, with one element, two, three…. What the counts have in common is
/// computed once. Not for several threads at once; it uses all cores itself.
class CoverSearch {
public:
    /// Starts a search. The solid must outlive it. Throws Error(usage) without kinds, for fewer than 4 vertices, and
    /// for an objective that the kinds do not have; Error(geometry) for geometry without extent or out of bounds.
    CoverSearch(const Solid& solid, const CoverOptions& options);
    ~CoverSearch();
    CoverSearch(const CoverSearch&) = delete;
    CoverSearch& operator=(const CoverSearch&) = delete;

    /// Returns at most `count` elements, whatever was requested before. Along 1, 2, 4, 8, 16, 64, 256… elements, and
    /// for spheres along those of spherize_each(), more elements are never worse by the objective. Throws Error(usage)
    /// for a count of 0. Exceptions of `stop` pass through; the search remains usable.
    Cover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Returns at most `count` elements (at least 1) of the kinds that cover the whole surface of the solid and are good by
/// the objective. The result is the same on any number of threads. For spheres alone it is that of spherize(), but a
/// solid of no more than `count` balls is covered by these, unless the objective is the radius: nothing covers it with
/// less. Throws where CoverSearch does.
Cover cover(const Solid& solid, std::size_t count, const CoverOptions& options = {});
/// Returns the same for a mesh: metres, any frame.
Cover cover(const Mesh& mesh, std::size_t count, const CoverOptions& options = {});
/// Returns the same for points, each with a radius: the surface of the union of these balls is covered. See
/// solid_of_balls().
Cover cover(std::span<const Sphere> balls, std::size_t count, const CoverOptions& options = {});

} // namespace search
} // namespace foam
