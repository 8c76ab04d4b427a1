#include "stage.hpp"

FOAM_PLUGIN("filter_named_spherizer", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("spherize.filter"));
}
