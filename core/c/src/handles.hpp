// What the handles of foam.h hold.
#pragma once

#include <foam.h>

#include <foam/geometry/elements.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

struct foam_region {
    std::vector<foam::Sphere> balls; ///< of points; empty for a mesh

    explicit foam_region(std::shared_ptr<const foam::Solid> made) : solid_(std::move(made)) {}
    explicit foam_region(std::vector<foam::Sphere> points) : balls(std::move(points)) {}

    /// Returns the solid; of points it is made when it is first needed: the search for spheres does without.
    std::shared_ptr<const foam::Solid> solid() const;

private:
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const foam::Solid> solid_;
};

struct foam_elements {
    std::vector<foam::Element> all;
    std::vector<std::vector<double>> vertices; ///< of each, for hulls
};

struct foam_mesh {
    foam::Mesh mesh;
};

namespace foam::c {

/// Returns a mesh of the caller's arrays. Throws Error(usage) for a null pointer or absurd counts, Error(geometry) for
/// an index out of range, a number that is not finite and a mesh without a triangle.
Mesh mesh_of(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
             std::size_t triangle_count);
/// Returns a handle of the elements, which the caller owns.
foam_elements* handle_of(const std::vector<Element>& elements);
/// Returns the kinds of a sum of theirs. Throws Error(usage) for any other number.
std::vector<Element::Kind> kinds_in(unsigned sum);

} // namespace foam::c
