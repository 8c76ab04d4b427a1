#include "stage.hpp"

FOAM_PLUGIN("parameter_twice", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.parameter", {foam::Parameter::integer("leaves", 8).doc("Cells."),
                                                 foam::Parameter::number("leaves", 8).doc("Cells.")}));
}
