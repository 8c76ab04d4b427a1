// The repairs: triangles in, the closed surface of a solid out.
#include <foam/sdk/plugin.hpp>

#include "octree.hpp"
#include "soup.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

#include <memory>

namespace foam::repair {

class SoupFilter final : public MeshFilter {
public:
    explicit SoupFilter(const Parameters& parameters)
        : options_{.seam = parameters.number("seam"), .largest_hole = parameters.number("largest_hole")} {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (std::optional<Mesh> result = repaired(cleaned, options_, context)) {
            return std::move(*result);
        }
        const Topology defects = topology(cleaned.distinct);
        throw Error(ErrorCode::geometry,
                    fmt::format("the mesh is too broken to be repaired in place ({}); remedy: repair.auto or "
                                "repair.watertight, which rebuild the surface",
                                defects.closed_manifold()
                                    ? "closed, but too thin for its volume to be told from rounding"
                                    : describe(defects)));
    }

private:
    SoupOptions options_;
};

/// Throws Error(internal) if the mesh is not a closed 2-manifold with a volume, which is the contract of a repair.
inline void check_promise(const Mesh& mesh, const char* stage) {
    const Topology defects = topology(mesh);
    const double volume = signed_volume(mesh);
    if (!defects.closed_manifold() || !(volume > 0)) {
        throw Error(ErrorCode::internal, fmt::format("{} made a mesh that is not closed ({}, volume {:g})", stage,
                                                     describe(defects), volume));
    }
}

class WatertightFilter final : public MeshFilter {
public:
    explicit WatertightFilter(const Parameters& parameters)
        : options_{.leaves = static_cast<std::size_t>(parameters.integer("leaves")),
                   .fill_openings = parameters.boolean("fill_openings")},
          keep_closed_(parameters.boolean("keep_closed")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (keep_closed_) {
            if (std::optional<Mesh> closed = sound(cleaned, {}, context)) {
                context.log(Severity::debug, "closed already: not rebuilt");
                return std::move(*closed);
            }
        }
        context.log(Severity::info, fmt::format("rebuilt ({})", describe(topology(cleaned.distinct))));
        Mesh result = rebuilt(cleaned.distinct, options_, context);
        check_promise(result, "repair.watertight");
        return result;
    }

private:
    RebuildOptions options_;
    bool keep_closed_;
};

class AutoFilter final : public MeshFilter {
public:
    AutoFilter(const Parameters& parameters, const StageMaker& maker)
        : soup_{.seam = parameters.number("seam"), .largest_hole = parameters.number("largest_hole")},
          leaves_(static_cast<std::size_t>(parameters.integer("leaves"))),
          wrap_(maker.make<MeshFilter>("repair.wrap")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (std::optional<Mesh> result = repaired(cleaned, soup_, context)) {
            context.log(Severity::debug, "taken: repair.soup, the lightest repair whose result is a solid");
            return std::move(*result);
        }
        std::string trouble;
        for (const std::size_t leaves : {leaves_, 8 * leaves_, 64 * leaves_}) {
            if (std::optional<Mesh> result = watertight(cleaned.distinct, leaves, trouble, context)) {
                return std::move(*result);
            }
        }
        if (wrap_) {
            Mesh result = wrap_->apply(mesh, context);
            context.log(Severity::info, fmt::format("taken: repair.wrap; repair.watertight failed: {}", trouble));
            return result;
        }
        throw Error(ErrorCode::geometry,
                    fmt::format("no repair gave a solid ({}): {}; remedy: install the plugin with repair.wrap, or mend "
                                "the mesh by hand",
                                describe(topology(cleaned.distinct)), trouble));
    }

private:
    /// Returns nothing if the result does not meet the requirements; `trouble` is then the reason.
    static std::optional<Mesh> watertight(const Mesh& mesh, std::size_t leaves, std::string& trouble,
                                          Context& context) {
        try {
            Mesh result = rebuilt(mesh, {.leaves = leaves, .fill_openings = true}, context);
            check_promise(result, "repair.watertight");
            if (self_intersections(result).empty()) {
                context.log(Severity::info,
                            fmt::format("taken: repair.watertight with {} leaves; mending in place was not enough ({})",
                                        leaves, describe(topology(mesh))));
                return result;
            }
            trouble = "triangles of the rebuilt surface pass through each other";
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            trouble = error.what();
        }
        return std::nullopt;
    }

    SoupOptions soup_;
    std::size_t leaves_;
    std::unique_ptr<MeshFilter> wrap_; ///< null without the GPL plugin
};

} // namespace foam::repair

namespace {

using foam::Parameter;

Parameter seam() {
    return Parameter::number("seam", 1e-6)
        .unit("1")
        .bounds(0, 0.01)
        .doc("Vertices this near to each other, or to an edge, become one: share of the bounding box's diagonal.")
        .source("coordinates of that accuracy are what single precision files give after a transformation");
}

Parameter largest_hole() {
    return Parameter::number("largest_hole", 0.1)
        .unit("1")
        .bounds(0, 10)
        .doc(
            "Extent up to which a hole that is not flat is filled: share of the bounding box's diagonal. Flat ones are "
            "filled at any size.")
        .source(
            "at a flat opening the winding number is one half just on its plane; others are guesses, good if small");
}

Parameter leaves() {
    return Parameter::integer("leaves", 1000)
        .unit("1")
        .bounds(8, 10'000'000)
        .doc("Resolution of a rebuilt surface: the octree is refined until this many of its cells touch the input.")
        .source("manifold_leaves of Coumar et al., Foam, 2025");
}

Parameter fill_openings() {
    return Parameter::boolean("fill_openings", true)
        .doc(
            "The inside of a mesh with holes (generalised winding number above one half) becomes solid, too; otherwise "
            "flood fill enters by every hole wider than a cell and leaves a thin shell.")
        .source("foam judges spheres by that inside (Jacobson et al. 2013); the paper has flood fill alone");
}

Parameter keep_closed() {
    return Parameter::boolean("keep_closed", true)
        .doc("Do not rebuild a mesh that turning triangles and splitting vertices makes closed and 2-manifold: "
             "rebuilding loses detail finer than a cell and fills cavities.")
        .source("the original rebuilds always and inflates closed meshes by about 20 %");
}

} // namespace

FOAM_PLUGIN("repair", "1.0", "Apache-2.0") {
    using namespace foam::repair;
    enrol.add<AutoFilter>(
        {.name = "repair.auto",
         .summary = "The lightest repair that gives a solid: repair.soup, repair.watertight ever finer, repair.wrap.",
         .reference = "the references of the three",
         .revision = 3,
         .parameters = {seam(), largest_hole(), leaves()},
         .uses = {"repair.wrap"}});
    enrol.add<SoupFilter>(
        {.name = "repair.soup",
         .summary = "Repairs small defects in place: seams, T-junctions, orientation, duplicates, inner walls, holes; "
                    "refuses larger ones.",
         .reference =
             "Guéziec, Taubin, Lazarus, Horn: Cutting and Stitching, 2001; Barequet, Sharir: Filling Gaps in the "
             "Boundary of a Polyhedron, 1995; Jacobson et al.: Robust Inside-Outside Segmentation, 2013",
         .revision = 2,
         .parameters = {seam(), largest_hole()}});
    enrol.add<WatertightFilter>(
        {.name = "repair.watertight",
         .summary = "Closed, outward, 2-manifold surface around any triangles.",
         .reference =
             "Huang, Su, Guibas: Robust Watertight Manifold Surface Generation Method for ShapeNet Models, arXiv "
             "1802.01698, 2018",
         .revision = 3,
         .parameters = {leaves(), fill_openings(), keep_closed()}});
}
