// What libFuzzer calls.
#include "targets.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const foam::fuzz::Target run = foam::fuzz::find_target(FOAM_FUZZ_TARGET);
    run({reinterpret_cast<const char*>(data), size});
    return 0;
}
