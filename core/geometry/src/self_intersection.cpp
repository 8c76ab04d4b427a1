#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/self_intersection.hpp>

#include <limits>

namespace foam::inline geometry {
namespace {


double largest_coordinate(const Vec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

double sum_of_components(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns the sign of the volume of a b c d, positive if d is below the counter-clockwise triangle a b c; 0 where
/// rounding could change it: of this computation, or of the coordinates themselves by a unit in the last place.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = a - d, v = b - d, w = c - d;
    const double determinant =
        u.x * (v.y * w.z - v.z * w.y) + v.x * (w.y * u.z - w.z * u.y) + w.x * (u.y * v.z - u.z * v.y);
    const double permanent = std::abs(u.x) * (std::abs(v.y * w.z) + std::abs(v.z * w.y)) +
                             std::abs(v.x) * (std::abs(w.y * u.z) + std::abs(w.z * u.y)) +
                             std::abs(w.x) * (std::abs(u.y * v.z) + std::abs(u.z * v.y));
    const double coordinate =
        std::max({largest_coordinate(a), largest_coordinate(b), largest_coordinate(c), largest_coordinate(d)});
    const auto sign_beyond = [&](double lu, double lv, double lw) {
        // Shewchuk's 7 ε/2 with margin; 2 ε of a coordinate in each of the three differences.
        const double bound =
            8 * std::numeric_limits<double>::epsilon() * (permanent + coordinate * (lu * lv + lv * lw + lw * lu));
        return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
    };
    // Upper estimates of lengths, without roots, decide nearly always.
    const int sign = sign_beyond(sum_of_components(u), sum_of_components(v), sum_of_components(w));
    return sign != 0 ? sign : sign_beyond(norm(u), norm(v), norm(w));
}

struct TriangleCorners {
    std::array<Vec3, 3> p;
};

TriangleCorners corners_of(const Mesh& mesh, std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}};
}

/// Returns whether the segment, which ends on both sides of the triangle's plane, passes through the interior of the
/// triangle.
bool passes_through(const Vec3& from, const Vec3& to, const TriangleCorners& t) {
    const int first = orientation(from, to, t.p[0], t.p[1]);
    return first != 0 && first == orientation(from, to, t.p[1], t.p[2]) &&
           first == orientation(from, to, t.p[2], t.p[0]);
}

/// Returns whether a side of triangle i passes through triangle k. Sides that start at a corner of k only touch it
/// there.
bool side_passes_through(const Mesh& mesh, std::uint32_t i, std::uint32_t k) {
    const Triangle &sides = mesh.triangles[i], &other = mesh.triangles[k];
    std::array<bool, 3> shared{};
    for (std::size_t s = 0; s < 3; ++s) {
        shared[s] = sides[s] == other[0] || sides[s] == other[1] || sides[s] == other[2];
    }
    if (shared[0] + shared[1] + shared[2] > 1) {
        return false;
    }
    const TriangleCorners target = corners_of(mesh, k);
    std::array<int, 3> above{}; // side of the plane
    for (std::size_t s = 0; s < 3; ++s) {
        above[s] = shared[s] ? 0 : orientation(target.p[0], target.p[1], target.p[2], mesh.vertices[sides[s]]);
    }
    for (std::size_t s = 0; s < 3; ++s) {
        const std::size_t e = (s + 1) % 3;
        if (above[s] * above[e] < 0 && passes_through(mesh.vertices[sides[s]], mesh.vertices[sides[e]], target)) {
            return true;
        }
    }
    return false;
}

template <class Bounds> bool overlap(const Bounds& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

} // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(const Mesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Box> boxes(count);
    CancellationCounter asking(4096);
    for (std::size_t i = 0; i < count; ++i) {
        asking.check();
        for (const std::uint32_t corner : mesh.triangles[i]) {
            boxes[i].add(mesh.vertices[corner]);
        }
    }
    const Bvh bvh = Bvh::quick(boxes);
    std::vector<std::vector<std::uint32_t>> found(count);
    parallel_for(count, [&](std::size_t index) {
        const auto i = static_cast<std::uint32_t>(index);
        const auto is_near = [&](const BvhNode& node) { return overlap(node, boxes[index]); };
        geometry::for_each_entered(bvh, is_near, [&](std::uint32_t place) {
            const std::uint32_t k = bvh.order()[place];
            if (k > i && overlap(boxes[k], boxes[i]) &&
                (side_passes_through(mesh, i, k) || side_passes_through(mesh, k, i))) {
                found[index].push_back(k);
            }
        });
        std::sort(found[index].begin(), found[index].end());
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const std::uint32_t k : found[i]) {
            pairs.emplace_back(i, k);
        }
    }
    return pairs;
}

} // namespace foam::geometry
