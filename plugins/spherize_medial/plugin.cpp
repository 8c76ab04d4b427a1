#include "spherizer.hpp"

#include <foam/plugin.hpp>

FOAM_PLUGIN("spherize_medial", "1.0", "GPL-3.0-or-later") {
    enrol.add<foam::medial::MedialSpherizer>({
        .name = "spherize.medial",
        .summary = "Spheres by reducing an adaptive approximation of the medial axis.",
        .reference =
            "Bradshaw, O'Sullivan: Adaptive medial-axis approximation for sphere-tree construction. ACM TOG 23(1), "
            "2004; Wang et al.: Variational sphere set approximation for solid objects. The Visual Computer 22, 2006",
        .revision = 1,
        .parameters = foam::medial::Settings::parameters(),
        .extensions = {},
    });
}
