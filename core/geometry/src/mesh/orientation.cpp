#include "mesh/orientation.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <numeric>

namespace foam::inline geometry {
namespace {

class Reader {
public:
    explicit Reader(const Mesh& mesh) : mesh_(mesh), center_(bounds(mesh).center()), triangles_(mesh.triangles) {
        const std::vector<std::uint32_t> index = welded_indices(mesh);
        for (Triangle& t : triangles_) {
            t = {index[t[0]], index[t[1]], index[t[2]]};
        }
        patch_of_.assign(triangles_.size(), 0);
        reset();
        std::vector<char> use(triangles_.size());
        for (std::size_t i = 0; i < use.size(); ++i) {
            use[i] = facing_[i] != Facing::ignored;
        }
        all_sides_ = sides_by_edge(triangles_, mesh_.vertices.size(), use);
    }

    Reading read() {
        const bool clean = every_edge_joins_two();
        if (!clean) {
            resolve_copies();
        }
        Reading result;
        result.closed = clean || balanced(true) || balanced(false);
        turn_outwards();
        if (!result.closed) {
            result.rim = rim();
        }
        result.facing = std::move(facing_);
        return result;
    }

private:
    void reset() {
        facing_.assign(triangles_.size(), Facing::as_given);
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const auto& [a, b, c] = triangles_[i];
            if (a == b || b == c || c == a) {
                facing_[i] = Facing::ignored;
            }
        }
    }

    /// Calls visit(sides) for each edge of the triangles that count with its sides, as they face, until it returns
    /// false. Without `with_flat`, triangles without area do not count.
    template <class Visit> void for_each_counting_edge(Visit visit, bool with_flat = true) const {
        std::vector<Side> edge;
        CancellationCounter asking(1 << 16);
        for (auto side = all_sides_.begin(); side != all_sides_.end();) {
            asking.check();
            edge.clear();
            const Side first = *side;
            for (; side != all_sides_.end() && side->same_edge(first); ++side) {
                const std::uint32_t i = side->triangle();
                if (facing_[i] != Facing::ignored && (with_flat || area(i) > 0)) {
                    edge.push_back(*side);
                    edge.back().forward ^= facing_[i] == Facing::flipped;
                }
            }
            if (!edge.empty() && !visit(std::span<const Side>(edge))) {
                return;
            }
        }
    }

    double area(std::size_t i) const {
        const auto& [a, b, c] = triangles_[i];
        return norm(cross(mesh_.vertices[b] - mesh_.vertices[a], mesh_.vertices[c] - mesh_.vertices[a])) / 2;
    }

    double volume(std::size_t i) const {
        const auto& [a, b, c] = triangles_[i];
        const double v =
            dot(mesh_.vertices[a] - center_, cross(mesh_.vertices[b] - center_, mesh_.vertices[c] - center_)) / 6;
        return facing_[i] == Facing::flipped ? -v : facing_[i] == Facing::ignored ? 0 : v;
    }

    void flip(std::size_t i) {
        if (facing_[i] != Facing::ignored) {
            facing_[i] = facing_[i] == Facing::flipped ? Facing::as_given : Facing::flipped;
        }
    }

    /// Handles the common case in which nothing needs to be resolved, and finds the patches on the way. Precondition:
    /// as after reset().
    bool every_edge_joins_two() {
        bool clean = true;
        DisjointSets sets(triangles_.size());
        for_each_edge(all_sides_, [&](std::span<const Side> edge) {
            clean = clean && edge.size() == 2 && edge[0].forward != edge[1].forward;
            if (edge.size() == 2) {
                sets.unite(edge[0].triangle(), edge[1].triangle());
            }
        });
        CancellationCounter asking(1 << 16);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            asking.check();
            patch_of_[i] = sets.find(i);
        }
        return clean;
    }

    bool balanced(bool with_flat) const {
        bool result = true;
        const auto visit = [&](std::span<const Side> edge) {
            std::ptrdiff_t sum = 0;
            for (const Side& side : edge) {
                sum += side.forward ? 1 : -1;
            }
            return result = sum == 0;
        };
        for_each_counting_edge(visit, with_flat);
        return result;
    }

    /// Resolves equal faces: once, cancelled, or (double-sided components) one of each pair.
    void resolve_copies() {
        const std::vector<std::vector<std::uint32_t>> copies = groups_of_copies();
        if (copies.empty()) {
            reset();
            orient_patches();
            return;
        }
        const std::vector<std::uint32_t> component = components();
        std::vector<char> keep_one = mostly_double_sided(component, copies);
        while (true) {
            check_cancelled();
            reset();
            for (const auto& group : copies) {
                drop_copies(group, keep_one[component[group[0]]]);
            }
            orient_patches();
            // A double-sided component that does not become closed that way is not a solid.
            std::vector<char> open(triangles_.size(), 0);
            for_each_counting_edge([&](std::span<const Side> edge) {
                if (edge.size() != 2 || edge[0].forward == edge[1].forward) {
                    open[component[edge[0].triangle()]] = 1;
                }
                return true;
            });
            bool changed = false;
            for (std::size_t i = 0; i < open.size(); ++i) {
                if (keep_one[i] && open[i]) {
                    keep_one[i] = 0;
                    changed = true;
                }
            }
            if (!changed) {
                return;
            }
        }
    }

    std::vector<std::uint32_t> components() const {
        DisjointSets sets(triangles_.size());
        for_each_counting_edge([&](std::span<const Side> edge) {
            for (const Side& side : edge.subspan(1)) {
                sets.unite(edge[0].triangle(), side.triangle());
            }
            return true;
        });
        std::vector<std::uint32_t> result(triangles_.size());
        for (std::uint32_t i = 0; i < result.size(); ++i) {
            result[i] = sets.find(i);
        }
        return result;
    }

    /// Returns the triangles that count with their corners, in order of these. A counting sort by the lowest corner
    /// leaves a few to sort at each.
    std::vector<std::pair<Triangle, std::uint32_t>> sorted_by_corners() const {
        std::vector<std::uint32_t> start(mesh_.vertices.size() + 1, 0);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (facing_[i] != Facing::ignored) {
                ++start[*std::min_element(triangles_[i].begin(), triangles_[i].end()) + 1];
            }
        }
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<std::pair<Triangle, std::uint32_t>> sorted(start.back());
        std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (facing_[i] != Facing::ignored) {
                Triangle key = triangles_[i];
                std::sort(key.begin(), key.end());
                sorted[next[key[0]]++] = {key, i};
            }
        }
        for (std::size_t v = 0; v + 1 < start.size(); ++v) {
            if (start[v + 1] - start[v] > 1) {
                std::sort(sorted.begin() + start[v], sorted.begin() + start[v + 1]);
            }
        }
        return sorted;
    }

    /// Returns the groups of two or more triangles with the same three corners.
    std::vector<std::vector<std::uint32_t>> groups_of_copies() const {
        const std::vector<std::pair<Triangle, std::uint32_t>> by_corners = sorted_by_corners();
        std::vector<std::vector<std::uint32_t>> result;
        for (std::size_t k = 1; k < by_corners.size(); ++k) {
            if (by_corners[k].first != by_corners[k - 1].first) {
                continue;
            }
            if (k == 1 || by_corners[k - 1].first != by_corners[k - 2].first) {
                result.push_back({by_corners[k - 1].second});
            }
            result.back().push_back(by_corners[k].second);
        }
        return result;
    }

    /// Returns true if the corners are passed in ascending order, up to rotation.
    bool ascending(std::uint32_t i) const {
        const auto& [a, b, c] = triangles_[i];
        return (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
    }

    /// Returns the copies one way minus the copies the other way.
    std::ptrdiff_t surplus(const std::vector<std::uint32_t>& group) const {
        std::ptrdiff_t sum = 0;
        for (const std::uint32_t i : group) {
            sum += ascending(i) ? 1 : -1;
        }
        return sum;
    }

    std::vector<char> mostly_double_sided(const std::vector<std::uint32_t>& component,
                                          const std::vector<std::vector<std::uint32_t>>& copies) const {
        std::vector<std::size_t> all(triangles_.size(), 0), paired(triangles_.size(), 0);
        for (const std::uint32_t c : component) {
            ++all[c];
        }
        for (const auto& group : copies) {
            paired[component[group[0]]] += surplus(group) == 0 ? group.size() : 0;
        }
        std::vector<char> result(triangles_.size(), 0);
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = 2 * paired[i] > all[i];
        }
        return result;
    }

    void drop_copies(const std::vector<std::uint32_t>& group, bool keep_one) {
        const std::ptrdiff_t sum = surplus(group);
        bool kept = sum == 0 && !keep_one; // then nothing is kept
        for (const std::uint32_t i : group) {
            if (!kept && (sum == 0 || ascending(i) == (sum > 0))) {
                kept = true;
            } else {
                facing_[i] = Facing::ignored;
            }
        }
    }

    /// The triangles adjacent to a triangle's sides, and whether they are wound against it.
    struct Neighbours {
        std::array<std::uint32_t, 3> triangle;
        std::array<bool, 3> against;
        std::uint8_t count = 0;

        void add(std::uint32_t other, bool wound_against) {
            triangle[count] = other;
            against[count++] = wound_against;
        }
    };

    std::vector<Neighbours> neighbours_in_patches() const {
        std::vector<Neighbours> result(triangles_.size());
        for_each_counting_edge([&](std::span<const Side> edge) {
            if (edge.size() == 2 && edge[0].triangle() != edge[1].triangle()) {
                const bool against = edge[0].forward == edge[1].forward;
                result[edge[0].triangle()].add(edge[1].triangle(), against);
                result[edge[1].triangle()].add(edge[0].triangle(), against);
            }
            return true;
        });
        return result;
    }

    /// Makes patches (triangles joined over edges of exactly two) consistent, wound as most of their area.
    void orient_patches() {
        const std::vector<Neighbours> neighbours = neighbours_in_patches();
        std::vector<signed char> turned(triangles_.size(), -1);
        std::vector<std::uint32_t> patch;
        CancellationCounter asking(4096);
        for (std::uint32_t seed = 0; seed < triangles_.size(); ++seed) {
            if (turned[seed] >= 0) {
                continue;
            }
            patch.assign(1, seed);
            turned[seed] = 0;
            bool orientable = true;
            double area_turned = 0, area_kept = 0;
            for (std::size_t k = 0; k < patch.size(); ++k) {
                asking.check();
                const std::uint32_t i = patch[k];
                patch_of_[i] = seed;
                (turned[i] ? area_turned : area_kept) += area(i);
                const Neighbours& around = neighbours[i];
                for (std::size_t n = 0; n < around.count; ++n) {
                    const std::uint32_t j = around.triangle[n];
                    const auto wanted = static_cast<signed char>(turned[i] ^ static_cast<int>(around.against[n]));
                    if (turned[j] < 0) {
                        turned[j] = wanted;
                        patch.push_back(j);
                    }
                    orientable = orientable && turned[j] == wanted;
                }
            }
            const signed char odd_ones = area_turned > area_kept ? 0 : 1;
            for (const std::uint32_t i : patch) {
                if (orientable && turned[i] == odd_ones) {
                    flip(i);
                }
            }
        }
    }

    std::vector<RimEdge> rim() const {
        std::vector<RimEdge> result;
        for_each_counting_edge([&](std::span<const Side> edge) {
            std::ptrdiff_t sum = 0;
            for (const Side& side : edge) {
                sum += side.forward ? 1 : -1;
            }
            const std::uint32_t low = edge[0].low, high = edge[0].high;
            if (sum != 0) {
                result.push_back(sum > 0 ? RimEdge{low, high, sum} : RimEdge{high, low, -sum});
            }
            return true;
        });
        return result;
    }

    struct Shell {
        Box box;
        double volume = 0;
        bool closed = true;
        std::vector<std::uint32_t> triangles;
    };

    void turn_outwards() {
        double total = 0;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            total += volume(i);
        }
        if (total < 0) {
            for (std::size_t i = 0; i < triangles_.size(); ++i) {
                flip(i);
            }
        }
        check_cancelled();
        const std::vector<Shell> all = shells();
        for (std::size_t s = 0; s < all.size(); ++s) {
            check_cancelled();
            if (all[s].closed && all[s].volume < 0 && !in_another(all, s)) {
                for (const std::uint32_t i : all[s].triangles) {
                    flip(i);
                }
            }
        }
    }

    /// Returns the shells in the order of their first triangles.
    std::vector<Shell> shells() const {
        constexpr std::uint32_t none = 0xFFFFFFFFu;
        std::vector<std::uint32_t> shell_of(triangles_.size(), none); // of a patch, by its number
        std::vector<Shell> result;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (facing_[i] == Facing::ignored) {
                continue;
            }
            std::uint32_t& number = shell_of[patch_of_[i]];
            if (number == none) {
                number = static_cast<std::uint32_t>(result.size());
                result.emplace_back();
            }
            Shell& shell = result[number];
            shell.triangles.push_back(i);
            shell.volume += volume(i);
            for (const std::uint32_t corner : triangles_[i]) {
                shell.box.add(mesh_.vertices[corner]);
            }
        }
        for_each_counting_edge([&](std::span<const Side> edge) {
            for (const Side& side : edge) {
                result[shell_of[patch_of_[side.triangle()]]].closed &= edge.size() == 2;
            }
            return true;
        });
        return result;
    }

    /// Returns whether the other shells with positive volume wind around a corner of shell `s`.
    bool in_another(const std::vector<Shell>& all, std::size_t s) const {
        const Vec3 p = mesh_.vertices[triangles_[all[s].triangles[0]][0]];
        double winding = 0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            const Box& box = all[k].box;
            const bool holds = box.low.x <= p.x && box.low.y <= p.y && box.low.z <= p.z && p.x <= box.high.x &&
                               p.y <= box.high.y && p.z <= box.high.z;
            if (k == s || !holds || !(all[k].volume > 0)) {
                continue;
            }
            for (const std::uint32_t i : all[k].triangles) {
                const auto& [a, b, c] = triangles_[i];
                const double w = winding_of_triangle({mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]}, p);
                winding += facing_[i] == Facing::flipped ? -w : w;
            }
        }
        return winding > 0.5;
    }

    const Mesh& mesh_;
    Vec3 center_;
    std::vector<Triangle> triangles_; // triangles with welded corners
    std::vector<Side> all_sides_;     // of all triangles with three different corners, as given
    std::vector<Facing> facing_;
    std::vector<std::uint32_t> patch_of_;
};

} // namespace

Reading read_as_solid(const Mesh& mesh) {
    return Reader(mesh).read();
}

} // namespace foam::geometry
