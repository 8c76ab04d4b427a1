// One new stage, and one that fixture_stages has.
#include "stage.hpp"

FOAM_PLUGIN("taken", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.new"));
    enrol.add<Nothing>(info("repair.fixture"));
}
