// simplify.quadric: fewer triangles with nearly the same shape.
#include "collapse.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

namespace foam::simplify {
namespace {

void check(const Mesh& mesh, const Topology& defects) {
    if (mesh.triangles.empty()) {
        throw Error(ErrorCode::geometry, "the mesh has no triangles");
    }
    if (!defects.manifold() || !defects.oriented()) {
        throw Error(ErrorCode::geometry,
                    fmt::format("quadric simplification needs an oriented 2-manifold, but the mesh has {}; put "
                                "repair.auto before simplify.quadric",
                                describe(defects)));
    }
    const Vec3 size = bounds(mesh).size();
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 0 && extent < 1e90)) {
        throw Error(ErrorCode::geometry, extent > 0 ? "the mesh is too large for its volume to be computed"
                                                    : "the mesh has no extent: there is nothing to simplify");
    }
}

class SimplifyQuadric final : public MeshFilter {
public:
    explicit SimplifyQuadric(const Parameters& parameters)
        : ratio_(parameters.number("ratio")), target_(static_cast<std::size_t>(parameters.integer("target_triangles"))),
          least_(static_cast<std::size_t>(parameters.integer("min_triangles"))),
          volume_tolerance_(parameters.number("volume_tolerance")), max_distance_(parameters.number("max_distance")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check_corners(mesh);
        const Topology before = topology(mesh);
        check(mesh, before);
        const std::size_t wanted = wanted_triangles(mesh.triangles.size());
        Mesh result = wanted < mesh.triangles.size() ? simplified(mesh, wanted, context) : mesh;
        const Topology after = topology(result);
        if (before.closed_manifold() && !after.closed_manifold()) {
            throw Error(ErrorCode::internal, fmt::format("simplify.quadric broke a closed mesh: {}", describe(after)));
        }
        // The last collapse may remove two triangles.
        if (result.triangles.size() > wanted + 1 && wanted < mesh.triangles.size()) {
            context.log(
                Severity::info,
                fmt::format("{} triangles are left of {}, {} were wanted: no further edge may go without harm to "
                            "topology, shape, volume or distance",
                            result.triangles.size(), mesh.triangles.size(), wanted));
        }
        return result;
    }

private:
    /// Returns the simplified mesh. Quadrics know only distances to planes: a bound on the distance is therefore
    /// proved, and the simplification repeated with half the allowance until the proof holds.
    Mesh simplified(const Mesh& mesh, std::size_t wanted, Context& context) const {
        Limits limits{.triangles = wanted, .volume_change = volume_tolerance_};
        if (max_distance_ == 0) {
            return Collapse(mesh, limits, context).run();
        }
        for (limits.plane_distance = max_distance_; limits.plane_distance > 1e-3 * max_distance_;
             limits.plane_distance /= 2) {
            Mesh result = Collapse(mesh, limits, context).run();
            if (lies_within(max_distance_, mesh, result) && lies_within(max_distance_, result, mesh)) {
                return result;
            }
        }
        context.log(Severity::info, "no simplification within max_distance could be proved: the mesh stays");
        return mesh;
    }

    std::size_t wanted_triangles(std::size_t count) const {
        if (target_ > 0) {
            return std::max<std::size_t>(target_, 4);
        }
        const auto share = static_cast<std::size_t>(std::ceil(ratio_ * static_cast<double>(count)));
        return std::max({share, least_, std::size_t{4}});
    }

    double ratio_;
    std::size_t target_, least_;
    double volume_tolerance_, max_distance_;
};

} // namespace
} // namespace foam::simplify

FOAM_PLUGIN("simplify_quadric", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::simplify::SimplifyQuadric>(
        {.name = "simplify.quadric",
         .summary = "Collapses edges in the order of their quadric error; a closed 2-manifold stays one.",
         .reference = "Garland, Heckbert: Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997",
         .parameters =
             {
                 Parameter::number("ratio", 0.2)
                     .unit("1")
                     .bounds(0.0001, 1)
                     .doc("Share of the triangles that is kept.")
                     .source("simplification ratio of Coumar et al., Foam, 2025"),
                 Parameter::integer("target_triangles", 0)
                     .unit("1")
                     .bounds(0, 100'000'000)
                     .doc("Number of triangles to end with, instead of ratio and min_triangles; 0: these rule.")
                     .source("0: the ratio rules, as in the paper"),
                 Parameter::integer("min_triangles", 800)
                     .unit("1")
                     .bounds(4, 100'000'000)
                     .doc("The ratio takes no mesh below this number: coarse meshes, as collision meshes often are, "
                          "stay.")
                     .source("a fifth of the 4000 triangles and more that repair.watertight makes with 1000 leaves"),
                 Parameter::number("volume_tolerance", 0.02)
                     .unit("1")
                     .bounds(0, 1)
                     .doc("Largest change of the volume of each connected part of a closed mesh, as a share of it.")
                     .source("small against the excess volume of a sphere model (0.3 and more)"),
                 Parameter::number("max_distance", 0)
                     .unit("m")
                     .bounds(0, 1e6)
                     .doc(
                         "No point of the result is farther than this from the input, nor the other way round: proved. "
                         "0: no bound. For a bound alone set ratio and min_triangles to their least.")
                     .source("0: the ratio rules, as in the paper"),
             },
         .extensions = {}});
}
