// The repairs: triangles in, the closed surface of a solid out.
#include "auto_filter.hpp"
#include "soup_filter.hpp"
#include "watertight_filter.hpp"

#include <foam/sdk/plugin.hpp>

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
