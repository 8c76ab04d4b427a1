// Built with the strings of before C++11 (-D_GLIBCXX_USE_CXX11_ABI=0).
#include "stage.hpp"

#undef FOAM_ABI_FINGERPRINT
#define FOAM_ABI_FINGERPRINT                                                                                           \
    "foam-abi=" FOAM_ABI_TEXT(FOAM_ABI_EPOCH) " stdlib=" FOAM_ABI_STDLIB FOAM_ABI_DEBUG                                \
                                              " cxx11=0 sanitizer=" FOAM_ABI_SANITIZER

FOAM_PLUGIN("old_strings", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.strings"));
}
