// Identical corners of a raw mesh, and its connected components, in linear time.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns, for every vertex, the smallest index of a vertex at the same position (-0 equals 0).
std::vector<std::uint32_t> welded_indices(const Mesh& mesh);

/// Disjoint sets of the numbers below `count`, with path halving. The smallest member represents its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count);
    std::uint32_t find(std::uint32_t i);
    void unite(std::uint32_t a, std::uint32_t b);
    /// Returns the number of sets.
    std::size_t count() const;

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace geometry
} // namespace foam
