// An envelope whose texts and function are null.
#include "stage.hpp"

FOAM_ABI_NOTE

extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {
    static const foam_plugin_envelope_v1 envelope{
        sizeof(foam_plugin_envelope_v1), FOAM_ABI_EPOCH, FOAM_ABI_FINGERPRINT, nullptr, "1.0", "Apache-2.0", nullptr};
    return &envelope;
}
