// An envelope that contradicts its note.
#include "stage.hpp"

FOAM_ABI_NOTE

static void enrol_nothing(foam::Enrolment&) {}

extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {
    static const foam_plugin_envelope_v1 envelope{sizeof(foam_plugin_envelope_v1),
                                                  FOAM_ABI_EPOCH + 1,
                                                  "foam-abi=2 of the envelope",
                                                  "other_epoch",
                                                  "1.0",
                                                  "Apache-2.0",
                                                  &enrol_nothing};
    return &envelope;
}
