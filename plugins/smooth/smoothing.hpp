// Methods that smooth a mesh by moving its vertices; the triangles stay.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <cstdint>
#include <vector>

namespace foam::smooth {

enum class Weighting {
    uniform,   ///< all neighbours alike (umbrella operator, Taubin 1995)
    cotangent, ///< (cot α + cot β) / 2 over the edge's opposite angles (Pinkall, Polthier 1993), not below 0
};

struct Neighbour {
    std::uint32_t vertex;
    double weight;
};

/// Neighbours in rows: those of vertex i are [begin[i], begin[i + 1]). The weights of a row add up to 1; a vertex
/// without triangles has no neighbours.
struct Neighbourhood {
    std::vector<std::uint32_t> begin;
    std::vector<Neighbour> neighbours;

    /// Returns the weighted mean of f over the neighbours of vertex i; f[i] itself if there are none.
    Vec3 mean(const std::vector<Vec3>& f, std::size_t i) const;
};

Neighbourhood neighbourhood(const Mesh& mesh, Weighting weighting);

/// A smoothing method: a step computes new points from the present ones.
class Method {
public:
    virtual ~Method() = default;
    virtual void step(std::vector<Vec3>& points) = 0;
};

/// Laplacian smoothing: p ← p + λ (mean of the neighbours - p), all vertices at once. Shrinks.
class Laplacian final : public Method {
public:
    Laplacian(const Neighbourhood& around, double lambda) : around_(around), lambda_(lambda) {}
    void step(std::vector<Vec3>& points) override;

private:
    const Neighbourhood& around_;
    double lambda_;
    std::vector<Vec3> before_;
};

/// λ|μ smoothing: a Laplacian step that shrinks, then one with a negative factor that swells; together a low-pass
/// filter of the surface with pass band 1/λ + 1/μ (Taubin: A Signal Processing Approach to Fair Surface Design,
/// SIGGRAPH 1995, section 3). `lambda` > 0, `mu` < -lambda.
class Taubin final : public Method {
public:
    Taubin(const Neighbourhood& around, double lambda, double mu) : shrink_(around, lambda), swell_(around, mu) {}
    void step(std::vector<Vec3>& points) override {
        shrink_.step(points);
        swell_.step(points);
    }

private:
    Laplacian shrink_, swell_;
};

/// The HC algorithm of Vollmer, Mencl, Müller: Improved Laplacian Smoothing of Noisy Surface Meshes, Eurographics 1999,
/// section 3 (HC: Humphrey's classes): a Laplacian step, after which every vertex is pushed back by a mean of its own
/// and its neighbours' displacements from a mix of their previous and their first positions. `alpha`: share of the
/// first positions in that mix; `beta`: share of the vertex itself in the mean.
class Humphrey final : public Method {
public:
    Humphrey(const Neighbourhood& around, std::vector<Vec3> first, double alpha, double beta)
        : around_(around), first_(std::move(first)), alpha_(alpha), beta_(beta) {}
    void step(std::vector<Vec3>& points) override;

private:
    const Neighbourhood& around_;
    std::vector<Vec3> first_;
    double alpha_, beta_;
    std::vector<Vec3> before_, away_;
};

struct Limits {
    int iterations = 0;
    double move = 0;          ///< largest displacement of a vertex, as a share of the diagonal of the box
    double volume_change = 0; ///< largest |V - V₀| / |V₀| of a closed mesh
};

/// Returns the mesh after steps of `method`, with displacements limited by limits.move. Vertices of triangles that a
/// step would invert stay unchanged. Ends early, with a message, before a step that would violate the limit on a closed
/// mesh's volume: a mesh that is too coarse for smoothing would lose its shape.
Mesh smoothed(const Mesh& mesh, Method& method, const Limits& limits, Context& context);

} // namespace foam::smooth
