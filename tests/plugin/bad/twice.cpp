#include "stage.hpp"

FOAM_PLUGIN("twice", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.twice"));
    enrol.add<Nothing>(info("repair.twice"));
}
