// The parameters of spherize.medial, read once.
#pragma once

#include <foam/parameter.hpp>

#include <cstddef>
#include <vector>

namespace foam::medial {

struct Settings {
    enum class Optimiser { variational, simplex, balance };

    std::size_t depth, branch, tester_points, cover_points, cover_per_triangle, init_spheres, min_spheres;
    double error_factor;
    bool expand, merge, burst, optimise;
    Optimiser optimiser;
    std::size_t deepest_optimised_level;
    double balance_excess;

    explicit Settings(const Parameters& parameters);
    static std::vector<Parameter> parameters();
};

} // namespace foam::medial
