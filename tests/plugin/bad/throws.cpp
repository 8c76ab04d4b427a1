// Throws when half of its stages are enrolled.
#include "stage.hpp"

#include <stdexcept>

FOAM_PLUGIN("throws", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.half"));
    throw std::runtime_error("half way");
}
