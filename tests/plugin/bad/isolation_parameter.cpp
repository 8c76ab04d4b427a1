// A parameter with the name of a key that says how a stage is isolated.
#include "stage.hpp"

FOAM_PLUGIN("isolation_parameter", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.patient", {foam::Parameter::number("time_limit", 8).unit("s").doc("Patience.")}));
}
