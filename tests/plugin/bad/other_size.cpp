// An envelope with a field more than this foam knows.
#include "stage.hpp"

FOAM_ABI_NOTE

static void enrol_nothing(foam::Enrolment&) {}

extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {
    static const foam_plugin_envelope_v1 envelope{sizeof(foam_plugin_envelope_v1) + 8,
                                                  FOAM_ABI_EPOCH,
                                                  FOAM_ABI_FINGERPRINT,
                                                  "other_size",
                                                  "1.0",
                                                  "Apache-2.0",
                                                  &enrol_nothing};
    return &envelope;
}
