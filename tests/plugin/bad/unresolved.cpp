// Needs a function that no library has.
#include "stage.hpp"

int function_that_nobody_has();

FOAM_PLUGIN("unresolved", "1.0", "Apache-2.0") {
    if (function_that_nobody_has() > 0) {
        enrol.add<Nothing>(info("repair.unresolved"));
    }
}
