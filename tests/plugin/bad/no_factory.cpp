#include "stage.hpp"

FOAM_PLUGIN("no_factory", "1.0", "Apache-2.0") {
    enrol.add_stage(foam::StageKind::mesh_filter, info("repair.factory"), nullptr);
}
