// The note of a plugin, but no entry point.
#include <foam/sdk/abi.hpp>

FOAM_ABI_NOTE
