// Built against an earlier state of this epoch's headers, in which StageInfo lacks its last member. Its stage would be
// read beyond its end while it enrols.
#include "stage.hpp"

FOAM_PLUGIN("earlier_layout", "1.0", "Apache-2.0") {
    for (int i = 0; i < 100; ++i) {
        enrol.add<Nothing>(info("repair.earlier"));
    }
}
