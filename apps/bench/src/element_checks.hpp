// What collision libraries need for the elements of each model, and its tables.
#pragma once

#include "bench.hpp"
#include "queries/elements.hpp"

#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// The answers of one engine about one model, each query twice.
struct ElementReports {
    EngineReport near;  ///< of near pairs
    EngineReport whole; ///< of the robot
};

/// A robot's model by one method.
struct ElementCase {
    std::string robot, method;
    std::size_t each = 0;                ///< elements a link, at most
    std::size_t elements = 0;            ///< of the robot
    double price = 0;                    ///< the mean of its elements by the costs that a recipe has by default
    std::size_t shape_pairs = 0;         ///< that a check of the robot consists of
    std::vector<ElementReports> reports; ///< of each engine
};

struct ElementCheckResults {
    std::vector<std::string> engines;
    std::size_t poses = 0, pairs = 0; ///< near pairs of one query
    std::vector<ElementCase> cases;   ///< of a robot and a number of elements: one behind the other
    std::vector<std::string> missing; ///< robots that are not here
};

/// Returns the median time of a check without the movement of the bodies, s; NaN without answers.
double check_seconds(const EngineReport& report);
/// Returns the median time of a check with the movement of the bodies, s; NaN without answers.
double whole_seconds(const EngineReport& report);

Outcome told(const ElementCheckResults& results);

} // namespace foam::bench::experiment
