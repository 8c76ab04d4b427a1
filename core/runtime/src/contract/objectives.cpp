#include "allocate/objective.hpp"
#include "promises.hpp"

namespace foam::inline runtime {
namespace {

/// Returns the objectives of the stage that the runtime knows, by their names.
std::map<std::string, Objective> known_objectives(const StageInfo& info) {
    std::map<std::string, Objective> known;
    for (const Parameter& p : info.parameters) {
        for (const std::string& choice : p.name == info.objective_parameter ? p.choices : std::vector<std::string>()) {
            if (const auto objective = objective_named(choice)) {
                known.emplace(choice, *objective);
            }
        }
    }
    return known;
}

void check_least(const RegisteredStage& stage, const Registry& registry,
                 const std::map<std::string, Objective>& objectives) {
    const auto solid = sample::solids().at("Bracket")();
    std::map<std::string, SphereTree> found_by;
    for (const auto& [name, unused] : objectives) {
        QuietContext context{3};
        const auto spherizer =
            registry.make<Spherizer>(stage.info.name, {{stage.info.objective_parameter, ParameterValue(name)}});
        found_by[name] = spherizer->spherize({"Bracket", solid, solid}, {8, {}, Guarantee::outer}, context);
    }
    constexpr double chance = 1.05; // a search may be lucky with another objective
    for (const auto& [name, objective] : objectives) {
        const double own = figure_of(*solid, found_by.at(name).elements(), objective);
        for (const auto& [other, found] : found_by) {
            const double theirs = figure_of(*solid, found.elements(), objective);
            require(own <= chance * theirs,
                    fmt::format("Bracket, 8 spheres: {} is {:.3g} with {}: {}, but {:.3g} with {}; remedy: let "
                                "StageInfo::objective_parameter name the parameter that says what is to be least",
                                name, own, stage.info.objective_parameter, name, theirs, other));
        }
    }
}

} // namespace

void check_objectives(const RegisteredStage& stage, const Registry& registry, Promises& promises) {
    if (const auto objectives = known_objectives(stage.info); objectives.size() > 1) {
        promises.check("has least what its objective says", [&] { check_least(stage, registry, objectives); });
    }
}

} // namespace foam::runtime
