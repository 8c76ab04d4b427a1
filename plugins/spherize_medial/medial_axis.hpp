// The adaptive medial axis approximation (Bradshaw and O'Sullivan 2004, "Adaptive medial-axis approximation for
// sphere-tree construction", ACM TOG 23(1), section 4).
#pragma once

#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace foam::medial {

/// The vertices inside the solid of the Voronoi diagram of some surface points. Each is the centre of a medial sphere,
/// whose radius is the distance to the points that formed the vertex. Points are added where they improve most: below
/// the sphere that protrudes most, or where the surface is in no sphere.
class MedialAxis {
public:
    /// Prepares the diagram. `surface`: candidates for its points, dense on the surface. `inside`: whether a sphere,
    /// given by centre and radius, counts as inside.
    MedialAxis(std::vector<Vec3> surface, std::function<bool(const Sphere&)> inside);
    ~MedialAxis();
    MedialAxis(const MedialAxis&) = delete;
    MedialAxis& operator=(const MedialAxis&) = delete;

    /// Adds all surface points: their number determines the result, without adaptation (Hubbard 1996, section 4).
    void take_all(Context& context);
    /// Adds surface points until there are `count` spheres, or none protrudes and all of `cover` is covered.
    void refine(std::size_t count, std::span<const Vec3> cover, Context& context);
    /// Adds surface points until at least `count` spheres contain a point of `cover` and the largest protrusion among
    /// these has fallen by `error_factor`.
    void refine_region(std::size_t count, double error_factor, std::span<const Vec3> cover, Context& context);

    std::vector<Sphere> spheres() const;
    /// Returns the spheres that contain one of the points.
    std::vector<Sphere> touching(std::span<const Vec3> points) const;

private:
    struct Diagram;
    std::unique_ptr<Diagram> diagram_;
};

} // namespace foam::medial
