// Steps that make a fit better by any measure.
#pragma once

#include "fit_programme.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>

namespace foam::inline search::convex {

/// How far a descent goes. Lengths of steps are in units.
struct StepPlan {
    int most;                        ///< steps
    double first, longest, shortest; ///< lengths of steps
    double too_little = 0;           ///< share of the value: the last step gains less
};

/// Changes the fit by steps that make value(fit) less while it holds all points, until there are none: each step solves
/// the problem with the constraints made linear (a sequence of quadratic programmes). `least`: the value of the fit,
/// and then of the result. slopes(fit): those of the value, to within a factor.
template <class Value, class Slopes>
void descend(Fit& fit, double& least, const Cloud& cloud, const StepPlan& plan, bool keep_axes, Value value,
             Slopes slopes) {
    double reach = plan.first;
    std::vector<Constraint> constraints;
    for (int k = 0; k < plan.most && reach > plan.shortest; ++k) {
        check_cancelled();
        const Variables gradient = slopes(fit);
        const double steepness = gradient.norm();
        if (!(steepness > 0)) {
            return;
        }
        set_constraints(fit, cloud, reach, constraints, keep_axes);
        const Variables step = quadratic_step(gradient, steepness / reach, constraints);
        const Fit next = stepped(fit, step, cloud);
        const double reached = value(next);
        if (!(reached < least)) {
            reach = std::min(reach, step.norm()) / 4;
            continue;
        }
        const double before = least;
        fit = next;
        least = reached;
        reach = std::min(plan.longest, 2 * reach);
        if (before - least < plan.too_little * before) {
            return;
        }
    }
}

} // namespace foam::inline search::convex
