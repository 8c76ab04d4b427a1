#include "stage.hpp"

FOAM_PLUGIN("no_doc", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.doc", {foam::Parameter::integer("leaves", 8)}));
}
