// What came of asking, and how it is told.
#pragma once

#include "bench.hpp"
#include "queries/plan.hpp"
#include "queries/statistics.hpp"

#include <string>
#include <vector>

namespace foam::inline bench::experiment {

struct RobotQueries {
    std::string name;
    TwoModels models;
    std::vector<EngineReport> reports; ///< of each engine
};

struct QueryResults {
    EnvironmentRule rule;
    QueryCounts counts;
    std::vector<std::string> engines;
    std::vector<std::size_t> distances; ///< by engine: queries that ask for distances too
    std::string method;                 ///< that made spheres; empty: none did
    std::vector<RobotQueries> robots;
    std::vector<std::string> missing; ///< robots that are not here
};

std::size_t shape_count(const EngineRobot& robot);
Outcome told(const QueryResults& results);

} // namespace foam::bench::experiment
