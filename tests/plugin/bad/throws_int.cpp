#include "stage.hpp"

FOAM_PLUGIN("throws_int", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.half"));
    throw 42;
}
