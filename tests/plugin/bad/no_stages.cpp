#include <foam/sdk/plugin.hpp>

FOAM_PLUGIN("no_stages", "1.0", "Apache-2.0") {}
