// Edge collapse in the order of the quadric error, within limits.
#pragma once

#include "candidates.hpp"
#include "quadric.hpp"

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <limits>
#include <vector>

namespace foam::simplify {

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
