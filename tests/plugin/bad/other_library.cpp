// Built with another standard library.
#include "stage.hpp"

#undef FOAM_ABI_FINGERPRINT
#define FOAM_ABI_FINGERPRINT                                                                                           \
    "foam-abi=" FOAM_ABI_TEXT(FOAM_ABI_EPOCH) " stdlib=libc++ cxx11=- sanitizer=" FOAM_ABI_SANITIZER

FOAM_PLUGIN("other_library", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.library"));
}
