// smooth.laplacian, smooth.taubin and smooth.humphrey.
#include "smoothing.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

namespace foam::smooth {
namespace {

void check(const Mesh& mesh) {
    check_corners(mesh);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& p = mesh.vertices[i];
        // Cubes of coordinates must stay finite.
        if (!is_finite(p) || std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1e90) {
            throw Error(ErrorCode::geometry, fmt::format("vertex {} of the mesh is not finite or too far away", i));
        }
    }
}

Mesh apply(const Mesh& mesh, Method& method, const Limits& limits, Context& context) {
    Mesh result = smoothed(mesh, method, limits, context);
    double farthest = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        farthest = std::max(farthest, distance(mesh.vertices[i], result.vertices[i]));
    }
    context.metric("largest_move", farthest, "m");
    return result;
}

Limits limits_of(const Parameters& parameters) {
    return {.iterations = static_cast<int>(parameters.integer("iterations")),
            .move = parameters.number("max_move"),
            .volume_change = parameters.number("volume_tolerance")};
}

class LaplacianFilter final : public MeshFilter {
public:
    explicit LaplacianFilter(const Parameters& parameters)
        : limits_(limits_of(parameters)), lambda_(parameters.number("lambda")),
          weighting_(parameters.text("weights") == "uniform" ? Weighting::uniform : Weighting::cotangent) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check(mesh);
        const Neighbourhood around = neighbourhood(mesh, weighting_);
        Laplacian method(around, lambda_);
        return smooth::apply(mesh, method, limits_, context);
    }

private:
    Limits limits_;
    double lambda_;
    Weighting weighting_;
};

class TaubinFilter final : public MeshFilter {
public:
    explicit TaubinFilter(const Parameters& parameters)
        : limits_(limits_of(parameters)), lambda_(parameters.number("lambda")),
          mu_(-1 / (1 / lambda_ - parameters.number("pass_band"))) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check(mesh);
        const Neighbourhood around = neighbourhood(mesh, Weighting::uniform);
        Taubin method(around, lambda_, mu_);
        return smooth::apply(mesh, method, limits_, context);
    }

private:
    Limits limits_;
    double lambda_, mu_;
};

class HumphreyFilter final : public MeshFilter {
public:
    explicit HumphreyFilter(const Parameters& parameters)
        : limits_(limits_of(parameters)), alpha_(parameters.number("alpha")), beta_(parameters.number("beta")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check(mesh);
        const Neighbourhood around = neighbourhood(mesh, Weighting::uniform);
        Humphrey method(around, mesh.vertices, alpha_, beta_);
        return smooth::apply(mesh, method, limits_, context);
    }

private:
    Limits limits_;
    double alpha_, beta_;
};

foam::Parameter max_move() {
    return foam::Parameter::number("max_move", 0.01)
        .unit("1")
        .bounds(0, 1000)
        .doc("No vertex ends farther than this share of the bounding box's diagonal from where it was.")
        .source("without it, 10 iterations on a Panda link of 1200 triangles move flat regions by 6 % and more");
}

foam::Parameter volume_tolerance() {
    return foam::Parameter::number("volume_tolerance", 0.02)
        .unit("1")
        .bounds(0, 1000)
        .doc("Iterations end before a closed mesh's volume has changed by more than this share.")
        .source("ten iterations change the rebuilt and simplified Panda links by 0.4 to 2 %");
}

} // namespace
} // namespace foam::smooth

namespace foam::smooth {

static void add_laplacian(foam::Enrolment& enrol) {
    enrol.add<LaplacianFilter>(
        {.name = "smooth.laplacian",
         .summary = "Moves every vertex towards the mean of its neighbours; shrinks the mesh.",
         .reference = "Taubin: A Signal Processing Approach to Fair Surface Design, SIGGRAPH 1995, section 3",
         .parameters =
             {
                 Parameter::integer("iterations", 3)
                     .unit("1")
                     .bounds(0, 1000)
                     .doc("Number of steps.")
                     .source("few: each step shrinks"),
                 Parameter::number("lambda", 0.5)
                     .unit("1")
                     .bounds(0, 1)
                     .doc("Share of the way to the mean of the neighbours that a step takes.")
                     .source("trimesh filter_laplacian"),
                 Parameter::choice("weights", {"uniform", "cotangent"}, "uniform")
                     .doc("Neighbours count alike, or by the cotangents of the angles opposite of the edge, which "
                          "keeps the spacing of the vertices.")
                     .source("uniform as in trimesh filter_laplacian"),
                 max_move(),
                 volume_tolerance(),
             },
         .extensions = {}});
}

static void add_taubin(foam::Enrolment& enrol) {
    enrol.add<TaubinFilter>(
        {.name = "smooth.taubin",
         .summary = "Laplacian steps that shrink and swell by turns: noise goes, the volume stays.",
         .reference = "Taubin: A Signal Processing Approach to Fair Surface Design, SIGGRAPH 1995, section 3",
         .parameters =
             {
                 Parameter::integer("iterations", 10)
                     .unit("1")
                     .bounds(0, 1000)
                     .doc("Number of pairs of steps.")
                     .source("as smooth.humphrey"),
                 Parameter::number("lambda", 0.5)
                     .unit("1")
                     .bounds(0.01, 1)
                     .doc("Share of the way to the mean of the neighbours that a shrinking step takes.")
                     .source("trimesh filter_taubin"),
                 Parameter::number("pass_band", 0.1)
                     .unit("1")
                     .bounds(0.001, 0.9)
                     .doc(
                         "Frequency k = 1/λ + 1/μ below which the shape is kept; 0 would be its mean, 2 the noise from "
                         "vertex to vertex.")
                     .source("Taubin 1995, section 3: values from 0.01 to 0.1 give good results"),
                 max_move(),
                 volume_tolerance(),
             },
         .extensions = {}});
}

static void add_humphrey(foam::Enrolment& enrol) {
    enrol.add<HumphreyFilter>(
        {.name = "smooth.humphrey",
         .summary = "Laplacian smoothing that pushes vertices back towards where they came from; hardly shrinks.",
         .reference = "Vollmer, Mencl, Müller: Improved Laplacian Smoothing of Noisy Surface Meshes, Eurographics 1999",
         .parameters =
             {
                 Parameter::integer("iterations", 10)
                     .unit("1")
                     .bounds(0, 1000)
                     .doc("Number of steps.")
                     .source("trimesh filter_humphrey"),
                 Parameter::number("alpha", 0.1)
                     .unit("1")
                     .bounds(0, 1)
                     .doc("How much the first positions count against the latest ones: 0 smooths most.")
                     .source("trimesh filter_humphrey"),
                 Parameter::number("beta", 0.5)
                     .unit("1")
                     .bounds(0, 1)
                     .doc("How much a vertex is pushed back by its own move against its neighbours' moves.")
                     .source("trimesh filter_humphrey"),
                 max_move(),
                 volume_tolerance(),
             },
         .extensions = {}});
}

} // namespace foam::smooth

FOAM_PLUGIN("smooth", "1.0", "Apache-2.0") {
    foam::smooth::add_laplacian(enrol);
    foam::smooth::add_taubin(enrol);
    foam::smooth::add_humphrey(enrol);
}
