// Edges are collapsed in the order of their quadric error, as long as the surface stays what it is.
#pragma once

#include "quadric.hpp"

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <array>
#include <limits>
#include <queue>
#include <vector>

namespace foam::simplify {

struct Limits {
    std::size_t triangles = 0; ///< no further than this
    double volume_change = 0;  ///< largest |V - V₀| / |V₀| of a closed mesh's connected parts
    /// Largest root mean square distance of a vertex to the planes it stands for, in the unit of the mesh.
    double plane_distance = std::numeric_limits<double>::infinity();
};

/// Simplifies a 2-manifold, with or without boundary. No collapse changes the topology (link condition), turns a
/// triangle over or takes the volume out of its limits.
class Collapse {
public:
    /// Precondition: topology(mesh) is manifold and oriented.
    Collapse(const Mesh& mesh, const Limits& limits, Context& context);
    /// May end with more triangles than wanted, when no edge is left that may go.
    Mesh run();

private:
    struct Candidate {
        double cost;
        std::uint32_t u, v;
        std::uint32_t stamp_u, stamp_v; ///< of the vertices when the cost was computed
        bool operator>(const Candidate& other) const;
    };

    void number_parts();
    void compute_quadrics();
    std::vector<std::array<std::uint32_t, 2>> edges() const;
    void propose(std::uint32_t u, std::uint32_t v);
    Vec3 placement(std::uint32_t u, std::uint32_t v, double& cost) const;
    std::vector<std::uint32_t> ring(std::uint32_t vertex) const;
    bool stays_near(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    bool keeps_topology(std::uint32_t u, std::uint32_t v) const;
    bool keeps_shape(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    double volume_gain(std::uint32_t u, std::uint32_t v, const Vec3& to) const;
    bool try_collapse(const Candidate& candidate);
    bool has(std::uint32_t triangle, std::uint32_t vertex) const;
    Mesh result() const;

    const Mesh& original_;
    Limits limits_;
    Context& context_;
    Vec3 center_; // work in the unit box
    double scale_ = 1;
    std::vector<Vec3> points_;
    std::vector<char> moved_;
    std::vector<Triangle> triangles_;
    std::vector<char> alive_;                              // triangles
    std::size_t count_ = 0;                                // of them
    std::vector<std::vector<std::uint32_t>> triangles_of_; // of each vertex
    std::vector<char> on_boundary_;                        // vertices
    std::vector<std::uint32_t> stamp_;
    std::vector<Quadric> quadrics_;
    std::vector<double> areas_;                    // weight of each quadric
    std::vector<std::uint32_t> part_;              // of each vertex: the connected part it belongs to
    std::vector<double> volumes_, volumes_before_; // of the parts
    bool closed_ = true;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
};

} // namespace foam::simplify
