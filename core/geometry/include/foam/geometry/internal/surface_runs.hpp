// Balls around runs of triangles that are close together.
#pragma once

#include <foam/geometry/solid.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

struct SolidData;

/// The triangles of a surface along a Morton curve, in short runs. What holds for the ball around a run holds for its
/// triangles: proofs, growth and searches look at few of many triangles.
class SurfaceRuns {
public:
    explicit SurfaceRuns(const SolidData& data);

    /// Coordinates are relative to the middle of the solid's bounds. The radius is infinite where the surface
    /// approximates a curved primitive, whose pieces are more than triangles for a proof.
    struct Run {
        Vec3 center;
        double radius;
    };
    std::size_t size() const { return runs_.size(); }
    const Run& operator[](std::size_t run) const { return runs_[run]; }
    std::span<const std::uint32_t> triangles(std::size_t run) const {
        const std::size_t begin = run * length;
        return std::span(order_).subspan(begin, std::min(length, order_.size() - begin));
    }
    /// The ball around `group_length` runs in order, or fewer at the end.
    static constexpr std::size_t group_length = 16;
    std::size_t group_count() const { return groups_.size(); }
    const Run& group(std::size_t index) const { return groups_[index]; }
    /// Largest distance of a vertex from the middle of the bounds.
    double extent() const { return extent_; }

private:
    static constexpr std::size_t length = 16;

    std::vector<std::uint32_t> order_;
    std::vector<Run> runs_, groups_;
    double extent_ = 0;
};

/// Returns the runs of a solid's surface. They are made on first use; safe from any number of threads.
const SurfaceRuns& surface_runs(const Solid& solid);

} // namespace geometry
} // namespace foam
