// Gives up in its entry point.
#include "../bad/stage.hpp"

#include <cstdlib>

FOAM_PLUGIN("aborts", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.abort"));
    std::abort();
}
