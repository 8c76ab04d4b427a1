// The nerve of convex elements: which of them have points in common. It tells whether their union has a void.
#pragma once

#include "proof/common_point.hpp"

#include <foam/base/cancellation.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace foam::inline geometry {

/// The nerve of elements, up to four at a time. docs/dev/certificate.md has the argument.
class Nerve {
public:
    /// Keeps references. Elements that hold nothing count as absent.
    Nerve(const Bodies& bodies, const Walls& walls);

    /// Proves that the space outside of the elements is connected: their union has no void. Returns false if it has
    /// one, or if that is in doubt. O(s · cost of a common point), with s sets of up to four elements that have one; in
    /// doubt where s is above 20,000 + 200 an element.
    bool has_no_void();

private:
    using Columns = std::vector<std::vector<std::uint32_t>>; ///< of a matrix of zeros and ones: the rows of the ones
    /// Elements that have a point in common.
    struct Simplex {
        std::array<std::uint32_t, 4> corners{}; ///< as many as it has, ascending
        std::uint32_t witness = 0;              ///< such a point
    };
    struct Witness {
        Vec3 point;
        std::vector<std::uint32_t> holders; ///< ascending
    };

    bool find_edges();
    bool find_triangles();
    bool find_tetrahedra();
    /// Returns whether the corners have a point in common, and appends their simplex then. `faces`: of it.
    bool meet(std::span<const std::uint32_t> corners, std::span<Simplex* const> faces);
    bool holds_all(std::uint32_t witness, std::span<const std::uint32_t> corners) const;
    std::uint32_t edge(std::uint32_t i, std::uint32_t j) const;
    std::uint32_t triangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
    Columns boundaries_of_tetrahedra() const;
    Columns boundaries_of_triangles(const std::vector<char>& left_out) const;

    const Bodies& bodies_;
    CommonPoint common_point_;
    std::size_t most_simplices_;
    std::vector<Witness> witnesses_;
    std::vector<Simplex> edges_, triangles_, tetrahedra_;
    std::vector<std::vector<std::uint32_t>> later_; ///< that each element has a point in common with
    std::unordered_map<std::uint64_t, std::uint32_t> edge_of_, triangle_of_;
    bool doubt_ = false;
    CancellationCounter asking_{64};
};

} // namespace foam::inline geometry
