// Robots of an experiment: where their files are looked for, and what is made of those that are here.
#pragma once

#include "bench.hpp"
#include "chain.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/internal/input.hpp>

#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// A robot by a name, and the candidates of its URDF.
struct NamedRobot {
    std::string name;
    std::vector<std::string> candidates;
    Location where; ///< in the experiment's file
};

/// Returns a recipe of the experiment for a robot, without a budget. `method`: null: without stages.
Recipe recipe_of(const Experiment& experiment, const NamedRobot& robot, const Chain* method);

/// Calls `use(robot, candidate)` with each robot that is here and the candidate that was taken. The others are told of.
/// Returns their names. Throws Error(input) if no robot is here.
template <class Robot, class Use>
std::vector<std::string> for_each_found(const Experiment& experiment, const Bench& bench,
                                        const std::vector<Robot>& robots, Use use) {
    std::vector<std::string> missing;
    std::string why;
    for (const Robot& robot : robots) {
        std::string candidate;
        try {
            resolve_input(recipe_of(experiment, robot, nullptr), &candidate);
        } catch (const Error& error) {
            bench.tell(fmt::format("warning: {}: {} is skipped: {}", experiment.name, robot.name, error.what()));
            missing.push_back(robot.name);
            why = error.what();
            continue;
        }
        use(robot, candidate);
    }
    if (missing.size() == robots.size()) {
        throw Error(ErrorCode::input, fmt::format("{}: none of the robots is here; {}", experiment.name, why));
    }
    return missing;
}

} // namespace foam::bench::experiment
