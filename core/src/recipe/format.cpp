#include "format.hpp"

#include <foam/host/length.hpp>
#include <foam/host/recipe.hpp>

#include <algorithm>

namespace foam::reading {

std::vector<Parameter> top_level_values() {
    return {
        Parameter::text("name", "").doc("Name of the run's folder; absent: the recipe's file name without its ending."),
        Parameter::integer("seed", 0).at_least(0).doc("Seed of all random choices."),
        Parameter::choice("unit", length_units(), "m")
            .doc("What the numbers of a single mesh are in, if its file does not say it; absent: m."),
        Parameter::number("scale", 1)
            .bounds(1e-12, 1e12)
            .unit("1")
            .doc("What a single mesh is enlarged by, besides its unit; absent: 1."),
        Parameter::choice("per", {"link", "collision"}, "link")
            .doc("Spherize each link as one solid, or every collision element on its own."),
        Parameter::choice("guarantee", {"outer", "inner", "fitted"}, "outer")
            .doc("outer: nothing of the geometry sticks out of the spheres, proved; inner: no sphere sticks out of the "
                 "geometry, proved; fitted: neither is promised."),
        Parameter::choice("on_error", {"stop", "skip", "fallback"}, "stop")
            .doc("When a link fails: stop the run, leave the link out, or stand its bounding sphere in for it."),
        Parameter::boolean("strict", false).doc("A glob in 'links' that names no link is an error, not a warning."),
    };
}

std::vector<Parameter> budget_values() {
    return {
        Parameter::integer("spheres", 1).at_least(1).unit("1").doc("Most spheres over the whole robot."),
        Parameter::number("excess", 0.5)
            .bounds(1e-6, 1e6)
            .unit("1")
            .doc("Volume that the spheres claim outside the geometry over the volume of the geometry, of the whole "
                 "robot: the fewest spheres that claim no more, as far as their number allows."),
        Parameter::number("max_protrusion", 0)
            .at_least(0)
            .unit("m")
            .doc("Largest distance by which spheres may stand out of the geometry, as far as the number of spheres "
                 "allows."),
        Parameter::number("time_limit", 10)
            .at_least(0.001)
            .unit("s")
            .doc("Time since the start in which the best spheres that are found are written; the run may not give the "
                 "same again. Absent: no limit."),
    };
}

std::vector<Parameter> link_values() {
    return {
        Parameter::boolean("skip", false).doc("Leave these links without spheres."),
        Parameter::integer("min_spheres", 1).at_least(1).unit("1").doc("Fewest spheres of each of these links."),
        Parameter::integer("max_spheres", 1).at_least(1).unit("1").doc("Most spheres of each of these links."),
        Parameter::number("weight", 1)
            .bounds(0, 1e6)
            .unit("1")
            .doc("How much the volume that these links' spheres claim wrongly counts when spheres are shared out."),
        Parameter::number("max_protrusion", 0).at_least(0).unit("m").doc("As in 'budget', for each of these links."),
    };
}

std::vector<Parameter> clip_values() {
    return {
        Parameter::number("offset", 0).unit("m").doc("Of the plane from the link's origin along the normal."),
        Parameter::number("reach", 0.005)
            .at_least(1e-6)
            .unit("m")
            .doc("How far beyond the plane spheres may reach. The less, the more spheres it takes."),
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
                 "Absent: as at the top level; there: as the stage wishes, else none."),
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

} // namespace foam::reading

namespace foam {

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

} // namespace foam
