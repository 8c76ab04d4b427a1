// Spheres in the loop: geometry in memory to spheres in memory, without recipe, files or plugins.
#pragma once

#include <foam/measure.hpp>
#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace foam {

/// How long spherize() looks for better spheres. What each costs: docs/guide/spherizers.md.
enum class Effort { fast, normal, best };

/// What spheres that hold a solid are to be besides; in covers by more spheres it never becomes worse.
enum class Objective {
    excess,     ///< the least volume outside the solid
    protrusion, ///< the least distance to which any sphere sticks out of the solid: the same clearance lost everywhere
    radius,     ///< the least largest radius: equal spheres at best (the k-centre problem), for planners that want one
};

/// By its name above; nothing for any other word.
std::optional<Objective> objective_named(std::string_view name);

struct SpherizeOptions {
    Effort effort = Effort::normal;
    Objective objective = Objective::excess;
    std::uint64_t seed = 0;
    /// Asked now and then in the calling thread; true ends the search with what has been found so far, covered and
    /// certified all the same.
    /// Results are the same from run to run only if it never says true.
    std::function<bool()> stop{};
};

/// Spheres that hold a solid, with the proof.
struct Cover {
    std::vector<Sphere> spheres; ///< m, in the solid's frame; at least one
    Certificate certificate;     ///< that solid.surface() lies in their union; it always holds
    double volume = 0;           ///< of their union, m³
};

/// The covers of one solid by one sphere, two, three…: each builds on those with fewer, and all that were made are kept
/// for later questions. Not for several threads at once; it uses all cores itself.
class CoverSearch {
public:
    /// The solid must outlive this.
    CoverSearch(const Solid& solid, const SpherizeOptions& options);
    ~CoverSearch();
    CoverSearch(const CoverSearch&) = delete;
    CoverSearch& operator=(const CoverSearch&) = delete;

    /// What spherize_each() gives, whatever was asked before. Throws Error(usage) for a count of 0. What `stop` throws
    /// comes out here; the search can be asked again.
    Cover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// At most `count` spheres (at least 1) that hold the whole surface of the solid and are good by the objective, by
/// which they are never worse than those that Objective::excess gives. With Effort::fast the count is looked for on its
/// own, for those who need one cover now; otherwise it is what spherize_each() gives. The same result on any number of
/// threads. Throws Error(geometry) where Solid::make does, Error(usage) for a count of 0.
Cover spherize(const Solid& solid, std::size_t count, const SpherizeOptions& options = {});
/// The same of a mesh: metres, any frame.
Cover spherize(const Mesh& mesh, std::size_t count, const SpherizeOptions& options = {});
/// One cover for each count, the same whatever the other counts are. Along the counts 1 to 12, 14, 16, 20, 24, 28, 32,
/// 40… more spheres are never worse by the objective (never claim more, protrude farther or have a larger one among
/// them); any other count is no worse than the one of these below it.
std::vector<Cover> spherize_each(const Solid& solid, std::span<const std::size_t> counts,
                                 const SpherizeOptions& options = {});

/// At most `count` spheres inside the solid, proved (certify_inner() holds), that hold as much of its volume as is
/// found: balls chosen one after another, then moved. Twice as many never hold less. None where no ball has room.
/// `stop` as in SpherizeOptions. Deterministic, on one thread. Throws Error(geometry) where inner_radii() does.
std::vector<Sphere> spheres_inside(const Solid& solid, std::size_t count, const std::function<bool()>& stop = {});

} // namespace foam
