// A mesh with its bounding-volume hierarchy and the queries on it.
#pragma once

#include "geometry/bvh.hpp"
#include "geometry/line_crossing.hpp"
#include "geometry/orientation.hpp"
#include "geometry/triangle.hpp"

#include <foam/mesh.hpp>

#include <vector>

namespace foam::geometry {

/// Where a line meets the surface, and what that does to the winding number.
struct Crossing {
    double t;
    int change; ///< +1 entering, -1 leaving
};

/// The nearest point found so far.
struct Nearest {
    double squared_distance;
    Vec3 point{};
    std::uint32_t triangle = 0;
};

/// Queries keep no state: safe from any number of threads, without allocation (but for crossings()).
class MeshPart {
public:
    /// `reading` of the mesh as read_as_solid() gives it.
    MeshPart(const Mesh& mesh, const Reading& reading);

    /// The triangles that count bound a solid without holes.
    bool closed() const { return closed_; }
    const Box& bounds() const { return box_; }
    /// By the divergence theorem; the volume if no point is wound around twice.
    double signed_volume() const { return signed_volume_; }

    /// Improves `nearest` if a triangle is nearer than nearest.squared_distance.
    void closest(const Vec3& p, Nearest& nearest) const;
    /// Whether a triangle comes within `distance` of `p`.
    bool touches(const Vec3& p, double distance) const;
    /// Inside (winding number above one half) or on the surface.
    bool contains(const Vec3& p) const;
    /// Generalised winding number: a whole number, exact, if closed; else to about 1e-3, exact near the surface.
    double winding(const Vec3& p) const;
    /// Crossings of a whole line, ascending by t; their changes sum to zero. Precondition: closed().
    void crossings(const Vec3& origin, const Vec3& direction, std::vector<Crossing>& result) const;

private:
    struct Item {
        Corners corners;
        std::uint32_t index;
        bool counts;
    };
    /// Far-field expansion of a node (winding.cpp).
    struct Moments {
        Vec3 center{};                  ///< about which the moments are taken
        double radius = -1;             ///< of the node's triangles about it; negative: none that counts
        Vec3 normal{};                  ///< ∫ n
        std::array<double, 6> second{}; ///< of the form ∫ (n·r)(y·r): xx, yy, zz, xy, yz, zx
        double trace = 0;               ///< ∫ n·y
        Vec3 third_trace{};             ///< ∫ 2 (n·y) y + n |y|²
        std::array<double, 10> third{}; ///< of ∫ (n·r)(y·r)²: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz

        void add(const Corners& corners);
        void add(const Moments& other);
        double winding(const Vec3& r, double r2) const;
    };

    template <class Visit> void visit_line(const Line& line, Visit visit) const;
    bool winding_by_line(const Vec3& p, int axis, int& winding) const;
    double winding_by_expansion(const Vec3& p) const;
    void compute_moments();
    double radius_about(const Vec3& center, std::uint32_t begin, std::uint32_t end) const;

    Bvh bvh_;
    std::vector<Item> items_;
    std::vector<Moments> moments_; // of open meshes only
    Box box_;
    double signed_volume_ = 0;
    double tolerance_ = 0; // rounding of coordinates: a point this near is on the surface
    bool closed_ = false;
};

} // namespace foam::geometry
