#include "stage.hpp"

FOAM_PLUGIN("bad_name", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.fine"));
    enrol.add<Nothing>(info("Repair-Nothing"));
}
