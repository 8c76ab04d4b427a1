// The note of a plugin, but no entry point.
#include <foam/abi.hpp>

FOAM_ABI_NOTE
