// Crashes before its entry point is called.
#include "../bad/stage.hpp"

#include <csignal>

namespace {

const int crash = std::raise(SIGSEGV);

} // namespace

FOAM_PLUGIN("crashes", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.crash"));
}
