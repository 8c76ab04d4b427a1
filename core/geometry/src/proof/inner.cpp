// Proof that balls lie in a solid, and shrinking of spheres until it succeeds.
#include "mesh/orientation.hpp"
#include "convex/kind.hpp"
#include "proof/rim.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/triangles.hpp>

#include <memory>
#include <optional>

namespace foam::inline geometry {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon();
/// Share of the solid's extent below which balls are not proved: nearer to the surface the solid angles that add up to
/// the winding number lose their digits.
constexpr double smallest_share = 1e-9;
/// Margin above the rounding errors of a sum of a hundred million solid angles.
constexpr double winding_margin = 1e-6;

/// Returns a lower bound of the distance from `p` to the triangle, sharp where the nearest point is known well. For any
/// unit vector the triangle lies beyond its corner that comes first along the vector.
double distance_at_least(const Corners& t, const Vec3& p) {
    const Vec3 towards = normalized(closest_on_triangle(t, p) - p);
    return std::min({dot(towards, t.a - p), dot(towards, t.b - p), dot(towards, t.c - p)});
}

/// The free space within one mesh, read as a solid.
class MeshRoom {
public:
    explicit MeshRoom(const Mesh& mesh) {
        const Reading reading = read_as_solid(mesh);
        std::vector<Box> boxes(mesh.triangles.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (const std::uint32_t corner : mesh.triangles[i]) {
                boxes[i].add(mesh.vertices[corner]);
            }
        }
        bvh_ = Bvh(boxes);
        for (const std::uint32_t i : bvh_.order()) {
            const auto& [a, b, c] = mesh.triangles[i];
            Corners corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
            if (reading.facing[i] == Facing::flipped) {
                std::swap(corners.b, corners.c);
            }
            triangles_.push_back(corners);
            if (reading.facing[i] != Facing::ignored) {
                counting_.push_back(corners);
            }
        }
        if (!reading.closed) {
            rim_ = Rim(counting_);
        }
    }

    /// Returns the largest radius up to `most` that is proved; 0 if it is below `least`.
    double radius(const Vec3& p, double least, double most) const {
        const double free = distance(p, most);
        if (!(free > least)) {
            return 0;
        }
        double winding = 0;
        CancellationCounter asking(1024);
        for (const Corners& t : counting_) {
            asking.check();
            winding += winding_of_triangle(t, p);
        }
        return rim_.radius_above_half(p, winding - winding_margin, free);
    }

private:
    /// Returns a lower bound of the distance to the surface where that is below `most`, and else `most`.
    double distance(const Vec3& p, double most) const {
        double nearest = most;
        const auto is_nearer = [&](const BvhNode& node) {
            return std::sqrt(squared_distance(node, p)) * (1 - 8 * unit) < nearest;
        };
        for_each_entered(bvh_, is_nearer,
                         [&](std::uint32_t k) { nearest = std::min(nearest, distance_at_least(triangles_[k], p)); });
        return nearest;
    }

    Bvh bvh_;
    std::vector<Corners> triangles_; ///< in the hierarchy's order
    std::vector<Corners> counting_;  ///< those that count for the winding number
    Rim rim_;
};

/// The free space within all parts of a solid. It is built from the solid's input, independent of its queries.
class Room {
public:
    explicit Room(const Solid& solid) {
        for (int axis = 0; axis < 3; ++axis) {
            extent_ = std::max({extent_, std::abs(solid.bounds().low[axis]), std::abs(solid.bounds().high[axis])});
        }
        least_ = smallest_share * solid.bounds().diagonal();
        for (const Solid::Part& part : solid.parts()) {
            if (part.primitive) {
                primitives_.emplace_back(*part.primitive, part.pose);
            } else if (!part.mesh->triangles.empty()) {
                meshes_.emplace_back(*part.mesh);
            }
        }
    }

    double radius(const Sphere& sphere) const {
        if (!is_finite(sphere.center) || !std::isfinite(sphere.radius)) {
            return 0;
        }
        // Differences of coordinates, products and sums of three, poses: in total below a few dozen units.
        const double slack = 64 * unit * (extent_ + norm(sphere.center));
        const double most = sphere.radius + slack;
        double radius = 0;
        for (const PrimitivePart& part : primitives_) {
            radius = std::max(radius, -part.signed_distance(sphere.center));
        }
        for (const MeshRoom& mesh : meshes_) {
            if (radius < most) {
                radius = std::max(radius, mesh.radius(sphere.center, std::max(least_, radius), most));
            }
        }
        // A ball with room for the slack is proved with its radius: most - slack may be rounded below it.
        radius = radius >= most ? sphere.radius : std::min(radius - slack, sphere.radius);
        return radius > least_ ? radius : 0;
    }

private:
    double extent_ = 0, least_ = 0;
    std::vector<PrimitivePart> primitives_;
    std::vector<MeshRoom> meshes_;
};

/// Returns a deep point of the solid within the ball, by pattern search on the signed distance (Hooke and Jeeves 1961).
Vec3 deep_point(const Solid& solid, const Sphere& sphere) {
    Vec3 best = sphere.center;
    double depth = -solid.signed_distance(best);
    for (double step = sphere.radius / 2; step > sphere.radius / 100;) {
        bool better = false;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 next = best;
                next[axis] += sign * step;
                const double there = -solid.signed_distance(next);
                if (distance(next, sphere.center) < sphere.radius && there > depth) {
                    best = next;
                    depth = there;
                    better = true;
                }
            }
        }
        step = better ? step : step / 2;
    }
    return best;
}

/// Removes the balls that lie in another; of equal ones the first stays.
void drop_contained(std::vector<Sphere>& spheres) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        check_cancelled();
        for (std::size_t j = 0; j < spheres.size() && spheres[i].radius > 0; ++j) {
            const double more = spheres[j].radius - spheres[i].radius;
            if ((more > 0 || (more == 0 && j < i)) && distance(spheres[i].center, spheres[j].center) <= more) {
                spheres[i].radius = 0;
            }
        }
    }
}

} // namespace
std::vector<double> inner_radii(const Solid& solid, std::span<const Sphere> spheres) {
    const geometry::Room room(solid);
    std::vector<double> radii(spheres.size());
    parallel_for(spheres.size(), [&](std::size_t i) { radii[i] = room.radius(spheres[i]); });
    return radii;
}

InnerCertificate certify_inner(const Solid& solid, std::span<const Sphere> spheres) {
    const std::vector<double> radii = inner_radii(solid, spheres);
    InnerCertificate certificate{true};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double excess = spheres[i].radius - radii[i];
        if (!(excess <= 0) && (certificate.holds || excess > certificate.excess)) {
            certificate = {false, i, excess};
        }
    }
    return certificate;
}

std::vector<Sphere> shrunk_to_fit(const Solid& solid, std::vector<Sphere> spheres) {
    parallel_for(spheres.size(), [&](std::size_t i) {
        if (is_finite(spheres[i].center) && std::isfinite(spheres[i].radius) && !solid.contains(spheres[i].center)) {
            spheres[i].center = geometry::deep_point(solid, spheres[i]);
        }
    });
    const std::vector<double> radii = inner_radii(solid, spheres);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        spheres[i].radius = radii[i];
    }
    geometry::drop_contained(spheres);
    return spheres;
}

} // namespace foam::geometry
