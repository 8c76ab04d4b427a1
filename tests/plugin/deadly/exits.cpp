// Ends the program.
#include "../bad/stage.hpp"

#include <unistd.h>

FOAM_PLUGIN("exits", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.exit"));
    _exit(7);
}
