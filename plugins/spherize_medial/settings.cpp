#include "stock.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace foam::medial {
namespace {

std::size_t count(const Parameters& parameters, const char* name) {
    return static_cast<std::size_t>(parameters.integer(name));
}

/// Returns the number of vertices of an icosahedron whose faces were split `levels` times: 12, 42, then about four
/// times as many per level; none at -1.
std::size_t tester_points(std::int64_t levels) {
    return levels < 0 ? 0 : levels == 0 ? 12 : std::size_t{42} << (2 * static_cast<std::size_t>(levels - 1));
}

Settings::Optimiser optimiser(const std::string& name) {
    return name == "simplex"   ? Settings::Optimiser::simplex
           : name == "balance" ? Settings::Optimiser::balance
                               : Settings::Optimiser::variational;
}

const std::string bradshaw = "Bradshaw and O'Sullivan 2004", field = "field default (Coumar et al. 2025)";

/// Returns the settings that all stages of the plugin have.
Settings shared(const Parameters& p) {
    Settings settings;
    settings.depth = count(p, "depth");
    settings.branch = count(p, "branch");
    settings.cover_points = count(p, "numCover");
    settings.cover_per_triangle = count(p, "minCover");
    settings.site_points = settings.cover_points;
    return settings;
}

std::vector<Parameter> tree_parameters() {
    return {
        Parameter::integer("depth", 1)
            .bounds(1, 6)
            .doc("Levels of the sphere tree below the bounding sphere.")
            .source(field),
        Parameter::integer("branch", 8)
            .bounds(1, 1000)
            .doc("Most children of a sphere; the number of spheres at depth 1 when there is no budget.")
            .source(field),
    };
}

std::vector<Parameter> cover_parameters() {
    return {
        Parameter::integer("numCover", 1000)
            .bounds(10, 1'000'000)
            .doc("Points spread over the surface that spheres must hold, beside its corners; more are taken for many "
                 "spheres.")
            .source("the paper's listing has 500, the field's tool 5000; the last steps also look at the surface "
                    "itself"),
        Parameter::integer("minCover", 5)
            .bounds(0, 1000)
            .doc("Least number of these points on a triangle that is larger than their spacing.")
            .source(field),
    };
}

std::vector<Parameter> joined(std::vector<std::vector<Parameter>> lists) {
    std::vector<Parameter> result;
    for (std::vector<Parameter>& list : lists) {
        std::move(list.begin(), list.end(), std::back_inserter(result));
    }
    return result;
}

} // namespace

Settings Settings::of_medial(const Parameters& p) {
    Settings settings = shared(p);
    settings.tester_points = medial::tester_points(p.integer("testerLevels"));
    settings.init_spheres = count(p, "initSpheres");
    settings.min_spheres = count(p, "minSpheres");
    settings.error_factor = p.number("erFact");
    settings.expand = p.boolean("expand");
    settings.merge = p.boolean("merge");
    settings.burst = p.boolean("burst");
    settings.divide = true;
    settings.optimise = p.boolean("optimise");
    settings.optimiser = medial::optimiser(p.text("optimiser"));
    settings.deepest_optimised_level = count(p, "maxOptLevel");
    settings.balance_excess = p.number("balExcess");
    return settings;
}

Settings Settings::of_hubbard(const Parameters& p) {
    Settings settings = shared(p);
    settings.source = Source::static_axis;
    settings.site_points = count(p, "num_samples");
    settings.sites_per_triangle = count(p, "min_samples");
    settings.merge = true;
    settings.compare_with_fewer = true;
    return settings;
}

Settings Settings::of_spawn(const Parameters& p) {
    Settings settings = shared(p);
    settings.source = Source::grid;
    settings.init_spheres = count(p, "initSpheres");
    settings.spawn = true;
    settings.compare_with_fewer = true;
    return settings;
}

std::vector<Parameter> Settings::hubbard_parameters() {
    return joined({tree_parameters(),
                   {Parameter::integer("num_samples", 200)
                        .bounds(10, 1'000'000)
                        .doc("Points spread over the surface whose Voronoi diagram gives the medial axis, beside its "
                             "corners; more are taken for many spheres.")
                        .source("the field's default is 500: on links of the Panda 200 gave no more excess"),
                    Parameter::integer("min_samples", 1)
                        .bounds(0, 1000)
                        .doc("Least number of these points on a triangle that is larger than their spacing.")
                        .source(field)},
                   cover_parameters()});
}

std::vector<Parameter> Settings::spawn_parameters() {
    return joined({tree_parameters(),
                   cover_parameters(),
                   {Parameter::integer("initSpheres", 500)
                        .bounds(1, 1'000'000)
                        .doc("About how many points of a grid over the solid's box are tried as first centres; more "
                             "are taken for many spheres.")
                        .source("as many as spherize.medial has medial spheres")}});
}

std::vector<Parameter> Settings::medial_parameters() {
    return joined({
        tree_parameters(),
        {Parameter::integer("testerLevels", 1)
             .bounds(-1, 4)
             .doc(
                 "Detail of the points that stand for a sphere when its exposed area is measured: 0 is 12 points, 1 is "
                 "42, each level four times as many; -1 takes no points, but volumes outside the solid along lines, "
                 "and leaves the variational step out: enough for convex parts.")
             .source("the field's default is 2: on the Panda's links it took 10 % more time and its excess was no "
                     "lower")},
        cover_parameters(),
        {Parameter::integer("initSpheres", 500)
             .bounds(1, 1'000'000)
             .doc("Spheres of the medial axis approximation for the whole surface.")
             .source(
                 "half the field's 1000: on the Panda's links the excess differed by less than 1 % up to 12 spheres"),
         Parameter::integer("minSpheres", 200)
             .bounds(1, 1'000'000)
             .doc("Least number of medial spheres for the region of one sphere, when its children are searched.")
             .source(field),
         Parameter::number("erFact", 2)
             .bounds(1, 1000)
             .unit("1")
             .doc("Factor by which refining the medial axis for a region must lower the greatest protrusion.")
             .source(field),
         Parameter::boolean("expand", true).doc("Try to reduce by expanding medial spheres.").source(field),
         Parameter::boolean("merge", true).doc("Try to reduce by merging neighbours.").source(field),
         Parameter::boolean("burst", false).doc("Try to reduce by bursting spheres.").source(field),
         Parameter::boolean("optimise", true).doc("Improve the spheres after the reduction.").source(field),
         Parameter::choice("optimiser", {"variational", "simplex", "balance"}, "variational")
             .doc("variational: descent of all spheres on the volume outside the solid, then simplex; simplex: centre "
                  "by "
                  "centre; balance: leave out spheres at little cost, then simplex.")
             .source("Wang et al. 2006; " + bradshaw),
         Parameter::integer("maxOptLevel", 1)
             .bounds(0, 6)
             .doc("Deepest level of the tree that is improved.")
             .source(field),
         Parameter::number("balExcess", 0.05)
             .bounds(0, 10)
             .unit("1")
             .doc("Volume outside the solid that leaving out one sphere may add, as a share of the solid's volume.")
             .source(field)},
    });
}

} // namespace foam::medial
