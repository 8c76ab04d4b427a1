// Built against a foam of another epoch.
#include "stage.hpp"

#undef FOAM_ABI_FINGERPRINT
#define FOAM_ABI_FINGERPRINT                                                                                           \
    "foam-abi=0 stdlib=" FOAM_ABI_STDLIB FOAM_ABI_DEBUG " cxx11=" FOAM_ABI_CXX11 " sanitizer=" FOAM_ABI_SANITIZER

FOAM_PLUGIN("epoch_in_note", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.epoch"));
}
