// Never comes back.
#include "../bad/stage.hpp"

#include <unistd.h>

FOAM_PLUGIN("loops", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.loop"));
    for (;;) {
        pause();
    }
}
