#include "objective.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <algorithm>

namespace foam::inline runtime {

std::optional<Objective> objective_of(const StageCall& spherizer, const Registry& registry) {
    const RegisteredStage* stage = registry.find(spherizer.stage);
    if (!stage || stage->info.objective_parameter.empty()) {
        return Objective::excess;
    }
    return objective_named(Parameters(stage->info.parameters, spherizer.given).text(stage->info.objective_parameter));
}

double figure_of(const Solid& solid, const std::vector<Sphere>& spheres, Objective objective) {
    switch (objective) {
    case Objective::excess:
        return cost_volume(solid, spheres, Guarantee::outer);
    case Objective::protrusion:
        return covered_protrusion(solid, spheres, Guarantee::outer);
    case Objective::radius:
        break;
    }
    double largest = 0;
    for (const Sphere& sphere : grown_to_cover(solid, spheres)) {
        largest = std::max(largest, sphere.radius);
    }
    return largest;
}

} // namespace foam::runtime
