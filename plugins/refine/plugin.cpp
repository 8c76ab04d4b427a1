// refine.*: better spheres from those of any spherizer.
#include "refiners.hpp"

#include <foam/sdk/plugin.hpp>

FOAM_PLUGIN("refine", "1.0", "Apache-2.0") {
    using namespace foam::refine;
    enrol.add<Fit>({.name = "refine.fit",
                    .summary = "Guarantee fitted: moves and sizes spheres so that they differ least from the shape.",
                    .reference = "Wang et al. 2006, Variational sphere set approximation for solid objects",
                    .revision = 3});
    enrol.add<Clip>({.name = "refine.clip",
                     .summary = "Replaces spheres that violate the half-space constraints of a link (clip).",
                     .reference = ""});
    enrol.add<Row>({.name = "refine.row",
                    .summary = "Covers a cylinder or capsule by a row of equal spheres, if that has less excess volume.",
                    .reference = ""});
    enrol.add<Split>({.name = "refine.split",
                      .summary = "Splits spheres while that reduces the excess volume, up to the budget.",
                      .reference = "Wang et al. 2006, Variational sphere set approximation for solid objects",
                      .revision = 2,
                      .adds_spheres = true});
}
