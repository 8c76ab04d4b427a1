#include "format.hpp"

#include <foam/recipe/recipe.hpp>

#include <algorithm>

namespace foam::inline recipe::reading {

std::vector<Parameter> clip_values() {
    return {
        Parameter::number("offset", 0).unit("m").doc("Distance of the plane from the link's origin, along the normal."),
        Parameter::number("reach", 0.005)
            .at_least(1e-6)
            .unit("m")
            .doc("How far spheres may extend beyond the plane. A smaller value needs more spheres."),
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
    static constexpr const char* keys[] = {"name",    "unit",         "scale",          "spheres",  "excess",
                                           "skip",    "min_spheres",  "max_protrusion", "weight",   "max_spheres",
                                           "isolate", "memory_limit", "time_limit",     "reach",    "cover",
                                           "pad",     "hollow",       "share",          "collision", "elements",
                                           "cost",    "covers"};
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

std::vector<std::string> top_level_structures() {
    return {"foam",   "extends",        "set",   "robot",   "mesh",      "package_path", "plugins", "loaders", "stages",
            "budget", "self_collision", "links", "outputs", "snapshots", "debug",        "sweep",   "variants"};
}

} // namespace foam::recipe::reading

namespace foam::inline recipe {

const std::vector<std::string>& words_of_share() {
    static const std::vector<std::string> words{"volume", "even", "protrusion"};
    return words;
}

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
