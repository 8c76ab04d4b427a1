// A license that no tool can look up.
#include "stage.hpp"

FOAM_PLUGIN("bad_license", "1.0", "free for all!") {
    enrol.add<Nothing>(info("repair.license"));
}
