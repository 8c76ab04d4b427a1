// A step along a gradient that keeps linear constraints.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace foam::inline search::convex {

constexpr int most_variables = 10;
using Variables = Eigen::Matrix<double, most_variables, 1>;

/// slope · step <= room
struct Constraint {
    Variables slope;
    double room;
};

/// Returns the step s with the least gradient · s + |s|² damping / 2 that keeps the constraints; zero where none keeps
/// them. The dual method of Goldfarb and Idnani (1983): the most violated constraint becomes active until none is
/// violated.
Variables quadratic_step(const Variables& gradient, double damping, const std::vector<Constraint>& constraints);

} // namespace foam::inline search::convex
