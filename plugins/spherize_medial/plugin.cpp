#include "spherizer.hpp"

#include <foam/sdk/plugin.hpp>

using foam::medial::MedialSpherizer;
using foam::medial::Settings;

/// Returns a factory. The stages share one class: they differ in the source of spheres and in their choice.
static foam::StageFactory maker(Settings (*settings)(const foam::Parameters&)) {
    return [settings](const foam::Parameters& parameters, const foam::StageMaker&) {
        return std::make_unique<MedialSpherizer>(settings(parameters));
    };
}

FOAM_PLUGIN("spherize_medial", "1.1", "GPL-3.0-or-later") {
    enrol.add_stage(
        foam::StageKind::spherizer,
        {
            .name = "spherize.medial",
            .summary = "Spheres by reducing an adaptive approximation of the medial axis.",
            .reference =
                "Bradshaw, O'Sullivan: Adaptive medial-axis approximation for sphere-tree construction. ACM TOG 23(1), "
                "2004; Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, "
                "2006",
            .revision = 5,
            .parameters = Settings::medial_parameters(),
            .extensions = {},
        },
        maker(&Settings::of_medial));
    enrol.add_stage(foam::StageKind::spherizer,
                    {
                        .name = "spherize.hubbard",
                        .summary = "Spheres by merging those of a medial axis of evenly spread surface points, each "
                                   "time the pair with the least cost.",
                        .reference = "Hubbard: Approximating polyhedra with spheres for time-critical collision "
                                     "detection. ACM TOG 15(3), 1996",
                        .revision = 3,
                        .parameters = Settings::hubbard_parameters(),
                        .extensions = {},
                    },
                    maker(&Settings::of_hubbard));
    enrol.add_stage(foam::StageKind::spherizer,
                    {
                        .name = "spherize.spawn",
                        .summary = "Spheres that all protrude by the same distance, placed one after another where "
                                   "they contain most of the part that is not covered yet.",
                        .reference = "Bradshaw, O'Sullivan: Adaptive medial-axis approximation for sphere-tree "
                                     "construction. ACM TOG 23(1), 2004, section 5.3 (spawning)",
                        .revision = 3,
                        .parameters = Settings::spawn_parameters(),
                        .extensions = {},
                    },
                    maker(&Settings::of_spawn));
}
