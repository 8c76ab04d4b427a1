#include "stage.hpp"

FOAM_PLUGIN("default_no_choice", "1.0", "Apache-2.0") {
    enrol.add<Nothing>(info("repair.choice", {foam::Parameter::choice("mode", {"fast", "exact"}, "slow").doc("How.")}));
}
