// An entry point that returns nothing.
#include "stage.hpp"

FOAM_ABI_NOTE

extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {
    return nullptr;
}
