// repair.watertight: any triangles in, the closed surface of a solid out.
#include "clean.hpp"
#include "distance.hpp"
#include "rebuild.hpp"
#include "weld.hpp"

#include <foam/error.hpp>
#include <foam/plugin.hpp>

#include <fmt/format.h>

namespace foam::watertight {
namespace {

/// Share of the diagonal: coordinates of that accuracy are what single precision files give after a transformation.
constexpr double seam_tolerance = 1e-6;

class Watertight final : public MeshFilter {
public:
    explicit Watertight(const Parameters& parameters)
        : options_{.leaves = static_cast<std::size_t>(parameters.integer("leaves")),
                   .fill_openings = parameters.boolean("fill_openings")},
          keep_closed_(parameters.boolean("keep_closed")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        Mesh result = repaired(cleaned, context);
        const Topology defects = topology(result);
        const double volume = signed_volume(result);
        if (!defects.closed_manifold() || !(volume > 0)) {
            throw Error(ErrorCode::internal,
                        fmt::format("repair.watertight made a mesh that is not closed ({}, volume {:g})",
                                    describe(defects), volume));
        }
        context.metric("volume_before", signed_volume(mesh), "m³");
        context.metric("volume_after", volume, "m³");
        context.metric("triangles", static_cast<double>(result.triangles.size()), "1");
        return result;
    }

private:
    Mesh repaired(const Cleaned& cleaned, Context& context) const {
        if (keep_closed_) {
            if (std::optional<Mesh> closed = kept(cleaned, context)) {
                context.log(Severity::debug, "closed already: not rebuilt");
                return std::move(*closed);
            }
        }
        context.log(Severity::info, fmt::format("rebuilt ({})", describe(topology(cleaned.distinct))));
        Mesh result = rebuilt(cleaned.distinct, options_, context);
        const Distances distances = sampled_distance(cleaned.distinct, result, context.seed());
        context.metric("distance_max", distances.max, "m");
        context.metric("distance_mean", distances.mean, "m");
        return result;
    }

    /// The mesh without rebuilding, if it bounds a solid as it is or but for seams.
    static std::optional<Mesh> kept(const Cleaned& cleaned, Context& context) {
        for (const Mesh* candidate : {&cleaned.distinct, &cleaned.all}) {
            if (std::optional<Mesh> closed = closed_manifold(*candidate, context)) {
                return closed;
            }
        }
        const Mesh sewn = welded_within(cleaned.distinct, seam_tolerance * bounds(cleaned.distinct).diagonal());
        std::optional<Mesh> closed = closed_manifold(sewn, context);
        if (closed) {
            context.log(Severity::info,
                        fmt::format("seams narrower than {:g} of the size were closed", seam_tolerance));
        }
        return closed;
    }

    RebuildOptions options_;
    bool keep_closed_;
};

} // namespace
} // namespace foam::watertight

FOAM_PLUGIN("repair_watertight", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::watertight::Watertight>(
        {.name = "repair.watertight",
         .summary = "Closed, outward, 2-manifold surface around any triangles.",
         .reference =
             "Huang, Su, Guibas: Robust Watertight Manifold Surface Generation Method for ShapeNet Models, arXiv "
             "1802.01698, 2018",
         .parameters =
             {
                 Parameter::integer("leaves", 1000)
                     .unit("1")
                     .bounds(8, 10'000'000)
                     .doc("Resolution of a rebuilt surface: the octree is refined until this many of its cells touch "
                          "the input.")
                     .source("manifold_leaves of Coumar et al., Foam, 2025"),
                 Parameter::boolean("fill_openings", true)
                     .doc("The inside of a mesh with holes (generalised winding number above one half) becomes solid, "
                          "too; otherwise flood fill enters by every hole wider than a cell and leaves a thin shell.")
                     .source(
                         "foam judges spheres by that inside (Jacobson et al. 2013); the paper has flood fill alone"),
                 Parameter::boolean("keep_closed", true)
                     .doc("Do not rebuild a mesh that turning triangles and splitting vertices makes closed and "
                          "2-manifold: rebuilding loses detail finer than a cell and fills cavities.")
                     .source("the original rebuilds always and inflates closed meshes by about 20 %"),
             },
         .extensions = {}});
}
