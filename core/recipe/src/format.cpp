#include "format.hpp"

#include <foam/geometry/length.hpp>
#include <foam/recipe/recipe.hpp>

#include <algorithm>

namespace foam::inline recipe::reading {

std::vector<Parameter> top_level_values() {
    return {
        Parameter::text("name", "").doc("Name of the run's folder; absent: the recipe's file name without its ending."),
        Parameter::integer("seed", 0).at_least(0).doc("Seed of all random choices."),
        Parameter::choice("unit", length_units(), "m")
            .doc("Unit of a single mesh, for formats without a unit; absent: m."),
        Parameter::number("scale", 1)
            .bounds(1e-12, 1e12)
            .unit("1")
            .doc("Scale factor of a single mesh, in addition to its unit; absent: 1."),
        Parameter::choice("per", {"link", "collision"}, "link")
            .doc("Spherize each link as one solid, or every collision element on its own."),
        Parameter::choice("guarantee", {"outer", "inner", "fitted"}, "outer")
            .doc("outer: the spheres are proved to cover the geometry; inner: the spheres are proved to lie inside the "
                 "geometry; fitted: neither is proved."),
        Parameter::choice("on_error", {"stop", "skip", "fallback"}, "stop")
            .doc("When a link fails: stop the run, skip the link, or replace it by one enclosing sphere."),
        Parameter::boolean("strict", false).doc("A glob in 'links' that matches no link is an error, not a warning."),
    };
}

std::vector<Parameter> budget_values() {
    return {
        Parameter::integer("spheres", 1).at_least(1).unit("1").doc("Maximum number of spheres of the whole robot."),
        Parameter::number("excess", 0.5)
            .bounds(1e-6, 1e6)
            .unit("1")
            .doc("Excess of the whole robot: volume of the spheres outside the geometry / volume of the geometry. The "
                 "fewest spheres that reach it, as far as their number allows."),
        Parameter::number("max_protrusion", 0)
            .at_least(0)
            .unit("m")
            .doc("Largest distance by which spheres may extend beyond the geometry, as far as the number of spheres "
                 "allows."),
        Parameter::number("time_limit", 10)
            .at_least(0.001)
            .unit("s")
            .doc("Time from the start until the best spheres so far are written; another run may give other spheres. "
                 "Absent: no limit."),
    };
}

std::vector<Parameter> link_values() {
    return {
        Parameter::boolean("skip", false).doc("Make no spheres for these links."),
        Parameter::integer("min_spheres", 1)
            .at_least(1)
            .unit("1")
            .doc("Minimum number of spheres of each of these links."),
        Parameter::integer("max_spheres", 1)
            .at_least(1)
            .unit("1")
            .doc("Maximum number of spheres of each of these links."),
        Parameter::number("weight", 1)
            .bounds(0, 1e6)
            .unit("1")
            .doc("Factor of the excess volume of these links in the allocation of spheres."),
        Parameter::number("max_protrusion", 0).at_least(0).unit("m").doc("As in 'budget', for each of these links."),
    };
}

std::vector<Parameter> clip_values() {
    return {
        Parameter::number("offset", 0).unit("m").doc("Distance of the plane from the link's origin, along the normal."),
        Parameter::number("reach", 0.005)
            .at_least(1e-6)
            .unit("m")
            .doc("How far spheres may extend beyond the plane. A smaller value needs more spheres."),
    };
}

std::vector<Parameter> debug_values() {
    return {
        Parameter::boolean("meshes", false).doc("Write every link's mesh after each stage."),
        Parameter::boolean("snapshots", false).doc("Write a picture of every link after each stage."),
    };
}

std::vector<Parameter> isolation_values() {
    return {
        Parameter::choice("isolate", {"none", "process"}, "none")
            .doc("process: each call runs in a child process, where a crash or a limit ends the call, not the run. "
                 "Absent: as at the top level; there: the default of the stage, otherwise none."),
        Parameter::number("time_limit", 60)
            .at_least(0.001)
            .unit("s")
            .doc("Longest time of one isolated call; absent: no limit."),
        Parameter::integer("memory_limit", 4096)
            .bounds(64, 1 << 30)
            .unit("MiB")
            .doc("Most memory of one isolated call; absent: no limit."),
    };
}

bool is_length(const Parameter& parameter) {
    return parameter.type == Parameter::Type::number && parameter.unit_text == "m";
}

bool is_optional(const std::string& key) {
    static constexpr const char* keys[] = {"name",    "unit",         "scale",          "spheres", "excess",
                                           "skip",    "min_spheres",  "max_protrusion", "weight",  "max_spheres",
                                           "isolate", "memory_limit", "time_limit",     "reach"};
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

std::vector<std::string> top_level_structures() {
    return {"foam",   "extends",        "set",   "robot",   "mesh",      "package_path", "plugins", "loaders", "stages",
            "budget", "self_collision", "links", "outputs", "snapshots", "debug",        "sweep",   "variants"};
}

} // namespace foam::recipe::reading

namespace foam::inline recipe {

const char* to_string(Guarantee guarantee) {
    switch (guarantee) {
    case Guarantee::outer:
        return "outer";
    case Guarantee::inner:
        return "inner";
    case Guarantee::fitted:
        return "fitted";
    }
    return "";
}

} // namespace foam::recipe
