// A point that convex elements have in common, or a proof that there is none.
#pragma once

#include "proof/walls.hpp"

#include <array>
#include <span>
#include <vector>

namespace foam::inline geometry {

enum class Meeting { common, none, doubt };

/// Finds points that elements have in common, by cutting planes (Kelley, The cutting-plane method for solving convex
/// programs, 1960). It tries the point nearest to the start within half-spaces that contain the elements. Each element
/// that does not hold this point adds a half-space.
class CommonPoint {
public:
    /// Keeps references.
    CommonPoint(const Bodies& bodies, const Walls& walls) : bodies_(bodies), walls_(walls) {}

    /// Returns whether elements have a point in common, proved with all rounding, or that it is in doubt. Sets `point`,
    /// where the search starts, to such a point.
    Meeting find(std::span<const std::uint32_t> elements, Vec3& point);

private:
    struct Cut {
        Vec3 normal;
        double offset; ///< normal · x <= offset in the element
        double margin; ///< of rounding
        double aim;    ///< how far inside to look for a point
    };
    bool add_cuts(std::span<const std::uint32_t> elements, const Vec3& point);
    bool nearest(const Vec3& start, Vec3& point);
    bool nearest_in_plane(std::size_t plane, const Vec3& start, Vec3& point);
    bool nearest_on_line(std::size_t plane, std::size_t second, const Vec3& start, Vec3& point);
    double beyond(std::size_t cut, const Vec3& p) const {
        return dot(cuts_[cut].normal, p) - cuts_[cut].offset + share_ * cuts_[cut].aim;
    }
    bool is_proved_empty(std::span<const std::uint32_t> elements) const;

    const Bodies& bodies_;
    const Walls& walls_;
    std::vector<Cut> cuts_;
    double share_ = 1; ///< of the aims
    std::array<std::size_t, 4> conflict_{};
    std::size_t conflicting_ = 0; ///< 0: in doubt
};

} // namespace foam::inline geometry
