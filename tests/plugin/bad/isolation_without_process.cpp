// Limits that only a process of its own could keep.
#include "stage.hpp"

FOAM_PLUGIN("isolation_without_process", "1.0", "Apache-2.0") {
    foam::StageInfo filter = info("repair.limited");
    filter.isolation.time_limit = 60;
    enrol.add<Nothing>(filter);
}
