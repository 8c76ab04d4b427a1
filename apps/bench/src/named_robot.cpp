#include "named_robot.hpp"

namespace foam::inline bench::experiment {

Recipe recipe_of(const Experiment& experiment, const NamedRobot& robot, const Chain* method) {
    Recipe recipe;
    recipe.file = experiment.file;
    recipe.name = experiment.name;
    recipe.urdf = robot.candidates;
    recipe.input_where = robot.where;
    if (method) {
        recipe.filters = method->filters;
        recipe.spherizer = *method->spherizer;
    }
    return recipe;
}

} // namespace foam::bench::experiment
