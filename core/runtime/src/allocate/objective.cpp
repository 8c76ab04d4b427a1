#include "allocate/objective.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/elements.hpp>

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

double figure_of(const Solid& solid, const Elements& elements, Objective objective) {
    if (elements.are_spheres()) {
        return figure_of(solid, elements.spheres(), objective);
    }
    switch (objective) {
    case Objective::excess:
        return cost_of_elements(solid, elements, Guarantee::outer);
    case Objective::protrusion:
        return protrusion_of_elements(solid, elements, Guarantee::outer);
    case Objective::radius:
        break;
    }
    const Elements grown = grown_to_cover(solid, elements);
    double largest = 0;
    for (const Sphere& sphere : grown.spheres()) {
        largest = std::max(largest, sphere.radius);
    }
    for (const Element& element : grown.shaped()) {
        largest = std::max(largest, minimum_enclosing_sphere(enclosing_mesh(element).vertices).radius);
    }
    return largest;
}

} // namespace foam::runtime
