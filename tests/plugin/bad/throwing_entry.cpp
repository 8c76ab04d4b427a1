// An entry point that throws.
#include "stage.hpp"

#include <stdexcept>

FOAM_ABI_NOTE

extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {
    throw std::runtime_error("no entry today");
}
