// A mesh with its bounding-volume hierarchy and the queries on it.
#pragma once

#include "mesh/line_crossing.hpp"
#include "mesh/needle_index.hpp"
#include "mesh/orientation.hpp"

#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline geometry {

/// The nearest point found so far.
struct Nearest {
    double squared_distance;
    Vec3 point{};
    std::uint32_t triangle = 0;
};

/// A mesh with its hierarchy. Queries keep no state: they are safe from any number of threads, without allocation
/// (except crossings()).
class MeshPart {
public:
    /// Number of triangles above which the mesh is not copied, and the hierarchy is quick to build.
    static constexpr std::size_t many = 100'000;

    /// `reading`: of the mesh, from read_as_solid(). The mesh must outlive this.
    MeshPart(const Mesh& mesh, const Reading& reading);

    /// Returns whether the triangles that count bound a solid without holes.
    bool closed() const { return closed_; }
    const Box& bounds() const { return box_; }
    /// Signed volume by the divergence theorem, of the surface and its closing surface; the volume if no point is wound
    /// around twice.
    double signed_volume() const { return signed_volume_; }

    /// Improves `nearest` if a triangle is nearer than nearest.squared_distance.
    void closest(const Vec3& p, Nearest& nearest) const;
    /// Returns whether a triangle comes within `distance` of `p`.
    bool touches(const Vec3& p, double distance) const;
    /// Returns whether `p` is inside (winding number above one half) or on the surface.
    bool contains(const Vec3& p) const;
    /// Returns the generalised winding number: a whole number, exact, if closed; else to about 1e-3, exact near the
    /// surface.
    double winding(const Vec3& p) const;
    /// Returns in `result` the crossings of a whole line with the surface and its closing surface, ascending by t;
    /// their changes sum to zero.
    void crossings(const Vec3& origin, const Vec3& direction, std::vector<Crossing>& result) const;

    /// Calls visit(corners) for each triangle of the surface that counts, and of its closing surface.
    template <class Visit> void for_each_closed(Visit visit) const {
        for_each_closed([](const Box&) { return true; }, visit);
    }
    /// Calls visit(corners) for these triangles. Of many it may leave out those in boxes for which wanted(box) is
    /// false.
    template <class Wanted, class Visit> void for_each_closed(Wanted wanted, Visit visit) const {
        for (const Item& item : items_) {
            if (item.counts) {
                visit(item.corners);
            }
        }
        Corners scratch;
        for (const BvhNode& node : bvh_.nodes()) {
            if (!items_.empty() || !node.leaf() || !wanted(Box{node.low, node.high})) {
                continue;
            }
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                if (counts(k)) {
                    visit(corners(k, scratch));
                }
            }
        }
        if (closing_) {
            closing_->for_each_closed(wanted, visit);
        }
    }

    /// Appends where the winding number is above one half on the `parts` of a line, ascending; some intervals may
    /// touch. `crossings`: those of the line. Whole stretches are decided at once where the closing surface cannot
    /// matter, the rest to the accuracy of the winding number. Precondition: not closed().
    void inside_along(const Vec3& origin, const Vec3& direction, std::span<const Crossing> crossings,
                      std::span<const Solid::Interval> parts, std::vector<Solid::Interval>& result) const;

private:
    struct Item {
        Corners corners;
        std::uint32_t index;
        bool counts;
    };
    enum class Triangles { copied, referred_to };
    /// Far-field expansion of a node (winding.cpp).
    struct Moments {
        Vec3 center{};                  ///< centre of the moments
        double radius = -1;             ///< radius of the node's triangles about it; negative: none counts
        double area = 0;                ///< area of the node's triangles that count
        Vec3 normal{};                  ///< ∫ n
        std::array<double, 6> second{}; ///< of the form ∫ (n·r)(y·r): xx, yy, zz, xy, yz, zx
        double trace = 0;               ///< ∫ n·y
        Vec3 third_trace{};             ///< ∫ 2 (n·y) y + n |y|²
        std::array<double, 10> third{}; ///< of ∫ (n·r)(y·r)²: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz

        void add(const Corners& corners);
        void add(const Moments& other);
        double winding(const Vec3& r, double r2) const;
    };

    struct Winding {
        double value;
        bool on_triangle; ///< the point lies on one or so near that rounding decides on which side
    };
    /// Makes a part without closing surface.
    MeshPart(const Mesh& mesh, const Reading& reading, Triangles triangles);

    void copy_triangles(const Mesh& mesh, const Reading& reading);
    /// The triangle at place `k` in bvh_.order(): whether it counts, and its corners, which may be put into `scratch`.
    bool counts(std::uint32_t k) const {
        return items_.empty() ? facing_[bvh_.order()[k]] != Facing::ignored : items_[k].counts;
    }
    const Corners& corners(std::uint32_t k, Corners& scratch) const {
        if (!items_.empty()) {
            return items_[k].corners;
        }
        const std::uint32_t i = bvh_.order()[k];
        const auto& [a, b, c] = mesh_->triangles[i];
        const bool flipped = facing_[i] == Facing::flipped;
        const std::vector<Vec3>& v = mesh_->vertices;
        return scratch = {v[a], v[flipped ? c : b], v[flipped ? b : c]};
    }
    template <class Visit> void visit_line(const Line& line, Visit visit) const;
    /// Computes the winding number of the surface and its closing surface.
    bool winding_by_line(const Vec3& p, int axis, int& winding) const;
    Winding winding_by_expansion(const Vec3& p) const;
    template <class Far, class Near> void visit_clusters(const Vec3& p, Far far, Near near) const;
    struct Variation {
        double value;     ///< the winding number at the middle, to about 1e-3
        double variation; ///< bound on the deviation within the ball; `most` and no value if it may be `most` or more
    };
    Variation winding_around(const Vec3& center, double radius, double most) const;
    /// Returns an upper bound of the absolute winding number in the box; infinity if it may be `enough` or more.
    double winding_at_most(const Box& region, double enough) const;
    void inside_part(const Vec3& origin, const Vec3& direction, double from, double to,
                     std::span<const Crossing> crossings, std::vector<Solid::Interval>& result) const;
    /// Appends the inside part of the line's stretch between `enter` and `leave`, which has no crossings; `winding`:
    /// there, of the surface and its closing surface.
    void inside_stretch(const Vec3& origin, const Vec3& direction, double enter, double leave, int winding,
                        std::vector<Solid::Interval>& result) const;
    /// Returns the moments of the nodes; none if closed. They are computed on first use: seldom are both sides of a
    /// surface with small holes in doubt. Safe from any number of threads.
    const std::vector<Moments>& moments() const;
    std::vector<Moments> computed_moments() const;
    double radius_about(const Vec3& center, std::uint32_t begin, std::uint32_t end) const;

    Bvh bvh_;
    std::vector<Item> items_;                 // in the order of bvh_; copied triangles only
    const Mesh* mesh_ = nullptr;              // of triangles that are referred to
    std::vector<Facing> facing_;              // likewise, of each triangle of the mesh
    std::optional<NeedleIndex> needles_;      // of meshes for which bvh_ separates too little
    mutable std::once_flag moments_once_;
    mutable std::vector<Moments> moments_;    // of open meshes only
    std::unique_ptr<const MeshPart> closing_; // of open meshes only: the closing surface
    bool quick_closing_ = false;              // the closing surface is quicker to query than the surface
    Box box_;
    double signed_volume_ = 0;
    double tolerance_ = 0; // rounding of coordinates: a point this near is on the surface
    bool closed_ = false;
};

} // namespace foam::geometry
