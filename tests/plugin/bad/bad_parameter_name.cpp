#include "stage.hpp"

FOAM_PLUGIN("bad_parameter_name", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.parameter", {foam::Parameter::integer("Number of cells", 8).doc("Cells.")}));
}
