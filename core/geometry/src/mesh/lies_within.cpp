#include "mesh/mesh_part.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <atomic>

namespace foam::inline geometry {
namespace {

/// A piece of a triangle that is not proved yet.
struct SmallTriangle {
    Corners corners;
    int depth;
};

void split_longest(const SmallTriangle& piece, std::vector<SmallTriangle>& open) {
    std::array<Vec3, 3> p{piece.corners.a, piece.corners.b, piece.corners.c};
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (distance(p[k], p[(k + 1) % 3]) > distance(p[longest], p[(longest + 1) % 3])) {
            longest = k;
        }
    }
    const Vec3 &from = p[longest], &to = p[(longest + 1) % 3], &tip = p[(longest + 2) % 3];
    const Vec3 middle = (from + to) * 0.5;
    open.push_back({{from, middle, tip}, piece.depth + 1});
    open.push_back({{middle, to, tip}, piece.depth + 1});
}

class WithinProof {
public:
    WithinProof(double limit, const Mesh& other)
        : other_(other), part_(other, {std::vector(other.triangles.size(), geometry::Facing::as_given), true}),
          squared_limit_(limit * limit) {}

    bool holds(const Corners& triangle) const {
        constexpr int most_splits = 40;
        std::vector<SmallTriangle> open{{triangle, 0}};
        CancellationCounter asking(64);
        while (!open.empty()) {
            asking.check();
            const SmallTriangle piece = open.back();
            open.pop_back();
            geometry::Nearest nearest{std::numeric_limits<double>::infinity()};
            part_.closest((piece.corners.a + piece.corners.b + piece.corners.c) / 3, nearest);
            if (!(nearest.squared_distance <= squared_limit_) || piece.depth >= most_splits) {
                return false;
            }
            if (!is_near(piece.corners, nearest.triangle)) {
                split_longest(piece, open);
            }
        }
        return true;
    }

private:
    bool is_near(const Corners& piece, std::uint32_t index) const {
        const Triangle& t = other_.triangles[index];
        const Corners target{other_.vertices[t[0]], other_.vertices[t[1]], other_.vertices[t[2]]};
        for (const Vec3& p : {piece.a, piece.b, piece.c}) {
            if (!(squared_norm(geometry::closest_on_triangle(target, p) - p) <= squared_limit_)) {
                return false;
            }
        }
        return true;
    }

    const Mesh& other_;
    geometry::MeshPart part_;
    double squared_limit_;
};

} // namespace

bool lies_within(double distance, const Mesh& surface, const Mesh& other) {
    const WithinProof proof(distance, other);
    std::atomic<bool> holds = true;
    parallel_for(surface.triangles.size(), [&](std::size_t i) {
        const Triangle& t = surface.triangles[i];
        if (holds.load(std::memory_order_relaxed) &&
            !proof.holds({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]})) {
            holds = false;
        }
    });
    return holds;
}

} // namespace foam::geometry
