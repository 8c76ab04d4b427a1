#include "settings.hpp"

#include <string>

namespace foam::medial {
namespace {

std::size_t count(const Parameters& parameters, const char* name) {
    return static_cast<std::size_t>(parameters.integer(name));
}

/// Vertices of an icosahedron whose faces were split: 42, then about four times as many a level.
std::size_t tester_points(std::int64_t levels) {
    return std::size_t{42} << (2 * static_cast<std::size_t>(levels - 1));
}

Settings::Optimiser optimiser(const std::string& name) {
    return name == "simplex"   ? Settings::Optimiser::simplex
           : name == "balance" ? Settings::Optimiser::balance
                               : Settings::Optimiser::variational;
}

} // namespace

Settings::Settings(const Parameters& p)
    : depth(count(p, "depth")), branch(count(p, "branch")),
      tester_points(medial::tester_points(p.integer("testerLevels"))), cover_points(count(p, "numCover")),
      cover_per_triangle(count(p, "minCover")), init_spheres(count(p, "initSpheres")),
      min_spheres(count(p, "minSpheres")), error_factor(p.number("erFact")), expand(p.boolean("expand")),
      merge(p.boolean("merge")), burst(p.boolean("burst")), optimise(p.boolean("optimise")),
      optimiser(medial::optimiser(p.text("optimiser"))), deepest_optimised_level(count(p, "maxOptLevel")),
      balance_excess(p.number("balExcess")) {}

std::vector<Parameter> Settings::parameters() {
    const std::string paper = "Bradshaw and O'Sullivan 2004", field = "field default (Coumar et al. 2025)";
    return {
        Parameter::integer("depth", 1)
            .bounds(1, 6)
            .doc("Levels of the sphere tree below the bounding sphere.")
            .source(field),
        Parameter::integer("branch", 8)
            .bounds(1, 1000)
            .doc("Most children of a sphere; the number of spheres at depth 1 when there is no budget.")
            .source(field),
        Parameter::integer("testerLevels", 1)
            .bounds(1, 4)
            .doc("Detail of the points that stand for a sphere when its exposed area is measured: 1 is 42 points, each "
                 "level four times as many.")
            .source(
                "the field's default is 2: on the Panda's links it took 10 % more time and its excess was no lower"),
        Parameter::integer("numCover", 1000)
            .bounds(10, 1'000'000)
            .doc("Points spread over the surface that spheres must hold, beside its corners; more are taken for many "
                 "spheres.")
            .source("the paper's listing has 500, the field's tool 5000; the simplex step also looks at the surface "
                    "itself"),
        Parameter::integer("minCover", 5)
            .bounds(0, 1000)
            .doc("Least number of these points on a triangle that is larger than their spacing.")
            .source(field),
        Parameter::integer("initSpheres", 500)
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
            .doc(
                "variational: descent of all spheres on the volume outside the solid, then simplex; simplex: centre by "
                "centre; balance: leave out spheres at little cost, then simplex.")
            .source("Wang et al. 2006; " + paper),
        Parameter::integer("maxOptLevel", 1)
            .bounds(0, 6)
            .doc("Deepest level of the tree that is improved.")
            .source(field),
        Parameter::number("balExcess", 0.05)
            .bounds(0, 10)
            .unit("1")
            .doc("Volume outside the solid that leaving out one sphere may add, as a share of the solid's volume.")
            .source(field),
    };
}

} // namespace foam::medial
