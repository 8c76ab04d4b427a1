#include "sized_mesh.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <queue>
#include <tuple>

namespace foam::inline bench::experiment {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

/// Splits edges of a growing mesh. A side is number 3 t + k: from corner k to corner k + 1 of triangle t.
class Refinement {
public:
    explicit Refinement(const Mesh& mesh)
        : mesh_(mesh), twins_(3 * mesh.triangles.size(), none), origins_(mesh.triangles.size()) {
        std::iota(origins_.begin(), origins_.end(), 0U);
        join_sides();
        for (std::uint32_t side = 0; side < twins_.size(); ++side) {
            enqueue(side);
        }
    }

    Mesh run(std::size_t triangles) {
        while (mesh_.triangles.size() < triangles) {
            const Edge longest = queue_.top();
            queue_.pop();
            if (squared_length(longest.side) == longest.squared_length) { // else it was split meanwhile
                split(longest.side);
            }
        }
        return in_order();
    }

private:
    struct Edge {
        double squared_length;
        std::uint32_t side;
        /// Of equal lengths the side that is older goes first.
        bool operator<(const Edge& other) const {
            return std::tie(squared_length, other.side) < std::tie(other.squared_length, side);
        }
    };

    std::uint32_t& corner(std::uint32_t side) { return mesh_.triangles[side / 3][side % 3]; }
    static std::uint32_t next(std::uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }

    double squared_length(std::uint32_t side) {
        const Vec3 along = mesh_.vertices[corner(next(side))] - mesh_.vertices[corner(side)];
        return dot(along, along);
    }

    /// An edge is queued by the lesser of its sides.
    void enqueue(std::uint32_t side) {
        if (twins_[side] == none || side < twins_[side]) {
            queue_.push({squared_length(side), side});
        }
    }

    /// Sides that run along one edge in opposite directions are twins, if the edge has no third.
    void join_sides() {
        std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> sides; // lesser corner, greater, side
        for (std::uint32_t side = 0; side < twins_.size(); ++side) {
            const auto [low, high] = std::minmax({corner(side), corner(next(side))});
            sides.emplace_back(low, high, side);
        }
        std::sort(sides.begin(), sides.end());
        const auto same = [](const auto& a, const auto& b) {
            return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
        };
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i + 1;
            while (end < sides.size() && same(sides[i], sides[end])) {
                ++end;
            }
            const std::uint32_t a = std::get<2>(sides[i]), b = std::get<2>(sides[end - 1]);
            if (end == i + 2 && corner(a) != corner(b)) {
                twins_[a] = b;
                twins_[b] = a;
            }
            i = end;
        }
    }

    void join(std::uint32_t a, std::uint32_t b) {
        twins_[a] = b;
        if (b != none) {
            twins_[b] = a;
        }
    }

    /// Cuts the triangle of `side` from the middle of that side to the corner across: it keeps the first half, a new
    /// triangle gets the second. Returns the new half of the side.
    std::uint32_t cut(std::uint32_t side, std::uint32_t middle) {
        const std::uint32_t second = next(side), third = next(second);
        const auto fresh = static_cast<std::uint32_t>(3 * mesh_.triangles.size());
        mesh_.triangles.push_back({middle, corner(second), corner(third)}); // sides: half, second, the cut
        twins_.resize(fresh + 3, none);
        origins_.push_back(origins_[side / 3]);
        join(fresh + 1, twins_[second]);
        join(fresh + 2, second);
        corner(second) = middle;
        return fresh;
    }

    void split(std::uint32_t side) {
        const std::uint32_t twin = twins_[side];
        const auto middle = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(0.5 * (mesh_.vertices[corner(side)] + mesh_.vertices[corner(next(side))]));
        const std::uint32_t half = cut(side, middle);
        std::array<std::uint32_t, 6> changed{side, next(side), half, next(half), none, none};
        if (twin != none) {
            const std::uint32_t other = cut(twin, middle);
            join(side, other);
            join(half, twin);
            changed[4] = next(twin);
            changed[5] = next(other);
        } else {
            twins_[side] = twins_[half] = none;
        }
        for (const std::uint32_t s : changed) {
            if (s != none) {
                enqueue(twins_[s] == none ? s : std::min(s, twins_[s]));
            }
        }
    }

    /// Pieces of a triangle one behind the other, vertices in the order of their first use: neighbours are near in
    /// memory, as in meshes of modellers. Edges are split all over the mesh, and times would tell of the cache.
    Mesh in_order() const {
        std::vector<std::uint32_t> order(mesh_.triangles.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return origins_[a] < origins_[b]; });
        std::vector<std::uint32_t> numbers(mesh_.vertices.size(), none);
        Mesh result;
        for (const std::uint32_t t : order) {
            Triangle triangle = mesh_.triangles[t];
            for (std::uint32_t& corner : triangle) {
                if (numbers[corner] == none) {
                    numbers[corner] = static_cast<std::uint32_t>(result.vertices.size());
                    result.vertices.push_back(mesh_.vertices[corner]);
                }
                corner = numbers[corner];
            }
            result.triangles.push_back(triangle);
        }
        return result;
    }

    Mesh mesh_;
    std::vector<std::uint32_t> twins_;
    std::vector<std::uint32_t> origins_; ///< of each triangle the one it is a piece of
    std::priority_queue<Edge> queue_;
};

} // namespace

Mesh refined(const Mesh& mesh, std::size_t triangles) {
    return mesh.triangles.size() >= triangles ? mesh : Refinement(mesh).run(triangles);
}

Mesh sized(const Mesh& mesh, std::size_t triangles, const Registry& registry, Context& context) {
    if (mesh.triangles.size() <= triangles) {
        return refined(mesh, triangles);
    }
    const auto simplify = registry.make<MeshFilter>(
        "simplify.quadric", {{"target_triangles", static_cast<std::int64_t>(triangles)}, {"volume_tolerance", 1.0}});
    return simplify->apply(mesh, context);
}

} // namespace foam::bench::experiment
