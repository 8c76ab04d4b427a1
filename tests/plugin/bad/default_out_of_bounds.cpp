#include "stage.hpp"

FOAM_PLUGIN("default_out_of_bounds", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.bounds", {foam::Parameter::integer("leaves", 0).bounds(8, 100).doc("Cells.")}));
}
