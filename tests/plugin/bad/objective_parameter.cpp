#include "stage.hpp"

FOAM_PLUGIN("objective_parameter", "1.0", "Apache-2.0") {
    foam::StageInfo wrong =
        info("repair.objective", {foam::Parameter::text("aim", "radius").doc("What is to be least.")});
    wrong.objective_parameter = "aim";
    enrol.add<Nothing>(std::move(wrong));
}
