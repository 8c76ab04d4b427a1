// What refiners do with spheres: clip them, fit them, split them.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// Returns whether the spheres keep the half-space constraints, by more than the rounding of their numbers.
bool keep_constraints(const Solid& solid, const std::vector<Sphere>& spheres, const std::vector<ClipPlane>& planes);

/// Returns at most `count` spheres that cover the solid and keep the half-space constraints, made from the given
/// spheres, which need not keep them. The result is slightly larger than needed and has a slightly larger distance to
/// the planes, so that its numbers can be rounded.
std::vector<Sphere> covering_within(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t count,
                                    const std::vector<ClipPlane>& planes, std::uint64_t seed);

/// Returns for each sphere the largest sphere in it that keeps the half-space constraints; leaves out spheres that have
/// none. The result need not cover anything.
std::vector<Sphere> shrunk_within(const Solid& solid, std::vector<Sphere> spheres,
                                  const std::vector<ClipPlane>& planes);

namespace fitted {

/// Revision of the method. Raise it when the same input gives other spheres: old cache entries are then ignored.
constexpr int revision = 4;

/// How far the search goes from its start.
enum class Reach {
    near, ///< descent only: every sphere stays near its start
    far,  ///< also other starts of as many spheres, and moves of spheres that contribute little to where much is
          ///< missing
};

/// Weights of what a fit makes least, excess · vol(U \ S) + missing · vol(S \ U) + (distance · mean + gap · high) · A.
/// A is the area of the surface, `mean` the mean distance of its points from U, 0 for points in U. `high` is a power
/// mean of these distances, which is near the gap. Where the solid is thin beside the spheres, distances count up
/// to 2.1 times as much.
struct FitWeights {
    double excess = 1, missing = 0.2, distance = 0.57, gap = 0.11;
};

/// Returns spheres moved and sized so that the weighted sum is small; `start` itself if nothing better is found, or if
/// the solid encloses no volume. As many as at the start or, with Reach::far, up to `most`. Deterministic.
/// `max_gap`: as within_gap() does in the end.
std::vector<Sphere> fit(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach,
                        const FitWeights& weights = {}, std::optional<double> max_gap = {});

/// Returns the spheres, grown where a point of the surface is farther than `max_gap` from them, m, above 0.
std::vector<Sphere> within_gap(const Solid& solid, std::vector<Sphere> spheres, double max_gap);

} // namespace fitted

namespace by_spheres {

/// Spheres and the joint volume of them and a solid, m³.
struct Claim {
    std::vector<Sphere> spheres;
    double volume;
};

/// Covering spheres of a solid that grow by one sphere at a time, whatever their source.
class Splitting {
public:
    /// The solid must outlive this.
    explicit Splitting(const Solid& solid);
    ~Splitting();

    /// Returns one sphere more. `cover` has the joint volume `volume` and covers the solid's surface. The result covers
    /// it too, up to rounding in single precision, which grown_to_cover() closes. One of the spheres becomes two that
    /// contain the part that the others do not cover, separated by a plane. It is the best of those with most excess
    /// volume if that reduces the volume, else of the next ones. If none does (around a ring two spheres have more
    /// volume than one), it is the best of all. Returns `cover` itself if no sphere can be split.
    Claim one_more(const std::vector<Sphere>& cover, double volume);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace by_spheres
} // namespace search
} // namespace foam
