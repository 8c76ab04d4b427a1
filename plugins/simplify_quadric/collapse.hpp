// Edge collapse in the order of the quadric error, within limits.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/context.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

namespace foam::simplify {

/// Q(x) = xᵀ A x + 2 bᵀ x + c: the weighted sum of squared distances to planes.
class Quadric {
public:
    /// Returns weight · (n·x + d)² for the plane through `point` with the unit normal n.
    static Quadric plane(const Vec3& point, const Vec3& normal, double weight);

    Quadric& operator+=(const Quadric& other) {
        xx_ += other.xx_;
        xy_ += other.xy_;
        xz_ += other.xz_;
        yy_ += other.yy_;
        yz_ += other.yz_;
        zz_ += other.zz_;
        b_ += other.b_;
        c_ += other.c_;
        return *this;
    }
    double error(const Vec3& x) const;
    /// Returns the point of least error. In directions that the planes do not determine, the one nearest to `near`.
    Vec3 minimizer(const Vec3& near) const;

private:
    Vec3 times(const Vec3& x) const;

    double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
    Vec3 b_;
    double c_ = 0;
};

/// Edge u v and the cost of its collapse.
struct Candidate {
    double cost;
    std::uint32_t u, v;
    std::uint32_t stamp_u, stamp_v; ///< of the vertices when the cost was computed

    bool operator>(const Candidate& other) const {
        return cost != other.cost ? cost > other.cost : u != other.u ? u > other.u : v > other.v;
    }
};

/// A priority queue that reads and writes memory in order, as in Sanders: Fast Priority Queues for Cached Memory, 2000.
/// A heap small enough for the cache takes new entries. A full heap becomes a sorted run, and runs of similar length
/// are merged. In one heap over the millions of edges of a large mesh every step would wait for memory.
class Candidates {
public:
    explicit Candidates(std::vector<Candidate> all) { add_run(std::move(all)); }

    bool empty() const { return runs_.empty() && heap_.empty(); }

    void push(const Candidate& candidate) {
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        if (heap_.size() == heap_limit) {
            add_run(std::move(heap_));
            heap_.clear();
        }
    }

    /// Removes and returns the candidate with the least cost. Precondition: not empty().
    Candidate pop() {
        std::size_t cheapest = runs_.size(); // the heap
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            if (cheapest == runs_.size() ? heap_.empty() || heap_.front() > runs_[r].back()
                                         : runs_[cheapest].back() > runs_[r].back()) {
                cheapest = r;
            }
        }
        if (cheapest == runs_.size()) {
            std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
            return taken_from(heap_);
        }
        const Candidate candidate = taken_from(runs_[cheapest]);
        if (runs_[cheapest].empty()) {
            runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(cheapest));
        }
        return candidate;
    }

private:
    using Run = std::vector<Candidate>; // the least cost at the end

    static constexpr std::size_t heap_limit = 8192;

    static Candidate taken_from(std::vector<Candidate>& list) {
        const Candidate candidate = list.back();
        list.pop_back();
        return candidate;
    }

    void add_run(std::vector<Candidate> candidates) {
        if (candidates.empty()) {
            return;
        }
        std::sort(candidates.begin(), candidates.end(), std::greater<>());
        runs_.push_back(std::move(candidates));
        while (runs_.size() > 1 && runs_[runs_.size() - 2].size() <= 2 * runs_.back().size()) {
            const Run last = std::move(runs_.back());
            runs_.pop_back();
            Run merged;
            merged.reserve(runs_.back().size() + last.size());
            std::merge(runs_.back().begin(), runs_.back().end(), last.begin(), last.end(), std::back_inserter(merged),
                       std::greater<>());
            runs_.back() = std::move(merged);
        }
    }

    std::vector<Run> runs_;
    std::vector<Candidate> heap_;
};

struct Limits {
    std::size_t triangles = 0; ///< at least this number
    double volume_change = 0;  ///< largest |V - V₀| / |V₀| of a closed mesh's connected parts
    /// Largest root mean square distance of a vertex to its planes, in the unit of the mesh.
    double plane_distance = std::numeric_limits<double>::infinity();
};

/// Simplifies a 2-manifold, with or without boundary. No collapse changes the topology (link condition), inverts a
/// triangle or exceeds the limit on the volume.
class Collapse {
public:
    /// Precondition: topology(mesh) is manifold and oriented.
    Collapse(const Mesh& mesh, const Limits& limits, Context& context);
    /// Simplifies the mesh. The result may have more triangles than requested if no other edge may collapse.
    Mesh run();

private:
    /// All data of a vertex in one place: most time is spent on fetching it from memory.
    struct alignas(64) Vertex {
        Vec3 point{};
        Quadric quadric{};
        double area = 0;         ///< weight of the quadric
        std::uint32_t stamp = 0; ///< grows when the vertex moves or is removed
        std::uint32_t part = 0;  ///< its connected part
        std::uint32_t mark = 0;  ///< the last walk around a vertex that reached it
        bool on_boundary = false, moved = false;
    };

    void number_parts();
    void compute_quadrics();
    std::vector<Candidate> candidates() const;
    Candidate candidate(std::uint32_t u, std::uint32_t v) const;
    bool is_stale(const Candidate& candidate) const;
    Vec3 placement(std::uint32_t u, std::uint32_t v, double& cost) const;
    template <class Visit> void for_each_neighbour(std::uint32_t vertex, Visit visit);
    bool stays_near(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    bool keeps_topology(std::uint32_t u, std::uint32_t v);
    bool keeps_shape(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    double volume_gain(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    bool try_collapse(const Candidate& candidate, Candidates& queue);
    bool has(std::uint32_t triangle, std::uint32_t vertex) const;
    Mesh result() const;

    const Mesh& original_;
    Limits limits_;
    Context& context_;
    Vec3 center_; // work in the unit box
    double scale_ = 1;
    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<char> alive_;                              // triangles
    std::size_t count_ = 0;                                // of them
    std::vector<std::vector<std::uint32_t>> triangles_of_; // of each vertex
    std::vector<double> volumes_, volumes_before_;         // of the parts
    bool closed_ = true;
    std::uint32_t walk_ = 0;
};

} // namespace foam::simplify
