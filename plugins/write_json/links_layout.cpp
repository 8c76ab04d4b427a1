#include "layout.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/measure_names.hpp>

#include <algorithm>

namespace foam {
namespace {

const char* guarantee_text(Guarantee guarantee) {
    switch (guarantee) {
    case Guarantee::outer:
        return "outer";
    case Guarantee::inner:
        return "inner";
    case Guarantee::fitted:
        return "fitted";
    }
    return "fitted";
}

std::string measures_object(const Measures& measures) {
    struct Text {
        std::string operator()(std::size_t count) const { return fmt::format("{}", count); }
        std::string operator()(double value) const { return json_number(value); }
        std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    };
    std::vector<std::string> members;
    for (const auto& [name, value] : named_figures(measures)) {
        members.push_back(fmt::format("\"{}\": {}", name, std::visit(Text{}, value)));
    }
    return fmt::format("{{{}}}", fmt::join(members, ", "));
}

std::string level_array(const SphereTree::Level& level) {
    std::vector<std::string> spheres;
    CancellationCounter asking(1024);
    for (std::size_t i = 0; i < level.spheres.size(); ++i) {
        asking.check();
        const Sphere& s = level.spheres[i];
        const std::string parent = i < level.parents.size() ? fmt::format(", \"parent\": {}", level.parents[i]) : "";
        spheres.push_back(fmt::format("            {{\"center\": {}, \"radius\": {}{}}}", json_point(s.center),
                                      number_text(s.radius), parent));
    }
    return fmt::format("          [\n{}\n          ]", fmt::join(spheres, ",\n"));
}

std::string group_object(const SphereGroup& group) {
    std::vector<std::string> geometries, levels;
    for (const std::string& geometry : group.geometries) {
        geometries.push_back(json_text(geometry));
    }
    for (const SphereTree::Level& level : group.tree.levels) {
        levels.push_back(level_array(level));
    }
    return fmt::format(
        "        {{\n          \"geometries\": [{}],\n          \"measures\": {},\n          \"levels\": [\n{}\n"
        "          ]\n        }}",
        fmt::join(geometries, ", "), measures_object(group.measures), fmt::join(levels, ",\n"));
}

std::string link_member(const LinkSpheres& link, const SphereModel& model) {
    std::vector<std::string> spheres, groups;
    for (const Sphere& s : link.spheres) {
        spheres.push_back(fmt::format("        [{}, {}, {}, {}]", number_text(s.center.x), number_text(s.center.y),
                                      number_text(s.center.z), number_text(s.radius)));
    }
    for (const SphereGroup& group : model.groups) {
        if (group.link == link.link) {
            groups.push_back(group_object(group));
        }
    }
    return fmt::format("    {}: {{\n      \"spheres\": [\n{}\n      ],\n      \"groups\": [\n{}\n      ]\n    }}",
                       json_text(link.link), fmt::join(spheres, ",\n"), fmt::join(groups, ",\n"));
}

} // namespace

std::string write_links_layout(const SphereModel& model) {
    require_writable(model);
    std::vector<std::string> links;
    for (const LinkSpheres& link : spheres_by_link(model)) {
        links.push_back(link_member(link, model));
    }
    const bool certified =
        !model.groups.empty() && std::all_of(model.groups.begin(), model.groups.end(),
                                             [](const SphereGroup& g) { return g.measures.certified; });
    return fmt::format(
        "{{\n  \"foam_spheres\": 1,\n  \"name\": {},\n  \"robot\": {},\n  \"guarantee\": \"{}\",\n"
        "  \"certified\": {},\n  \"units\": \"m\",\n  \"frame\": \"link\",\n  \"links\": {{\n{}\n  }}\n}}\n",
        json_text(model.name), json_text(model.robot ? model.robot->name : ""), guarantee_text(model.guarantee),
        certified, fmt::join(links, ",\n"));
}

SpheresByLink read_links_layout(const Json& document) {
    if (document.at("foam_spheres") != 1) {
        throw Error(ErrorCode::output, "JSON: foam_spheres is not 1: another version of the format");
    }
    SpheresByLink result;
    for (const auto& [name, link] : document.at("links").items()) {
        for (const Json& s : link.at("spheres")) {
            result[name].push_back(
                {{s.at(0).get<double>(), s.at(1).get<double>(), s.at(2).get<double>()}, s.at(3).get<double>()});
        }
    }
    return result;
}

} // namespace foam
