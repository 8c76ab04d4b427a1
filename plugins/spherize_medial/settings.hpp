// The parameters of the plugin's stages, read once.
#pragma once

#include <foam/sdk/parameter.hpp>

#include <cstddef>
#include <vector>

namespace foam::medial {

struct Settings {
    enum class Optimiser { variational, simplex, balance };
    /// The source of the spheres for the reductions.
    enum class Source {
        adaptive_axis, ///< a medial axis that is refined where it fits worst (Bradshaw and O'Sullivan 2004)
        static_axis,   ///< the medial axis of evenly spread surface points (Hubbard 1996)
        grid,          ///< points of a grid inside the solid, each with its depth
    };

    Source source = Source::adaptive_axis;
    std::size_t depth = 1, branch = 8;
    std::size_t cover_points = 1000, cover_per_triangle = 5;
    std::size_t site_points = 1000, sites_per_triangle = 1; ///< of the Voronoi diagram
    std::size_t init_spheres = 500, min_spheres = 200;
    double error_factor = 2;
    bool expand = false, merge = false, burst = false, spawn = false, divide = false;
    bool compare_with_fewer = false; ///< more spheres are only used if they have less excess volume than fewer
    bool optimise = false;
    Optimiser optimiser = Optimiser::variational;
    std::size_t tester_points = 42; ///< 0: exact volumes alone
    std::size_t deepest_optimised_level = 1;
    double balance_excess = 0.05;

    static Settings of_medial(const Parameters& parameters);
    static Settings of_hubbard(const Parameters& parameters);
    static Settings of_spawn(const Parameters& parameters);
    static std::vector<Parameter> medial_parameters();
    static std::vector<Parameter> hubbard_parameters();
    static std::vector<Parameter> spawn_parameters();
};

} // namespace foam::medial
