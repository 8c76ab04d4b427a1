#include "layout.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/writing.hpp>

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

/// Returns the numbers in lists of three, where there are more; one number alone.
std::string numbers_text(const std::string& name, const std::vector<double>& numbers) {
    if (numbers.size() == 1) {
        return number_text(numbers.front());
    }
    std::vector<std::string> points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        points.push_back(json_point({numbers[i], numbers[i + 1], numbers[i + 2]}));
    }
    return name == "rotation" || name == "vertices" ? fmt::format("[{}]", fmt::join(points, ", ")) : points.front();
}

/// Returns an element; `more`: a last member, or empty.
std::string element_object(const Element& element, const std::string& more) {
    std::string text = fmt::format("{{\"kind\": \"{}\"", to_string(element.kind));
    for (const auto& [name, numbers] : numbers_of(element)) {
        text += fmt::format(", \"{}\": {}", name, numbers_text(name, numbers));
    }
    return text + more + "}";
}

void append_numbers(const Json& value, std::vector<double>& numbers) {
    if (value.is_array()) {
        for (const Json& item : value) {
            append_numbers(item, numbers);
        }
        return;
    }
    numbers.push_back(value.get<double>());
}

Element read_element(const Json& object) {
    std::string kind;
    ElementNumbers numbers;
    for (const auto& [name, value] : object.items()) {
        if (name == "kind") {
            kind = value.get<std::string>();
        } else {
            numbers.emplace_back(name, std::vector<double>{});
            append_numbers(value, numbers.back().second);
        }
    }
    return element_of(kind, numbers);
}

std::string level_array(const SphereTree::Level& level) {
    std::vector<std::string> elements;
    CancellationCounter asking(1024);
    const auto parent = [&](std::size_t i) {
        return i < level.parents.size() ? fmt::format(", \"parent\": {}", level.parents[i]) : "";
    };
    for (std::size_t i = 0; i < level.elements.spheres().size(); ++i) {
        asking.check();
        const Sphere& s = level.elements.spheres()[i];
        elements.push_back(fmt::format("            {{\"center\": {}, \"radius\": {}{}}}", json_point(s.center),
                                       number_text(s.radius), parent(i)));
    }
    for (std::size_t i = level.elements.spheres().size(); i < level.elements.size(); ++i) {
        asking.check();
        elements.push_back("            " + element_object(level.elements[i], parent(i)));
    }
    return fmt::format("          [\n{}\n          ]", fmt::join(elements, ",\n"));
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
    std::vector<std::string> spheres, others, groups;
    for (const Element& element : link.elements.shaped()) {
        others.push_back("        " + element_object(element, ""));
    }
    for (const Sphere& s : link.elements.spheres()) {
        spheres.push_back(fmt::format("        [{}, {}, {}, {}]", number_text(s.center.x), number_text(s.center.y),
                                      number_text(s.center.z), number_text(s.radius)));
    }
    for (const SphereGroup& group : model.groups) {
        if (group.link == link.link) {
            groups.push_back(group_object(group));
        }
    }
    const std::string elements =
        others.empty() ? "" : fmt::format("      \"elements\": [\n{}\n      ],\n", fmt::join(others, ",\n"));
    return fmt::format("    {}: {{\n      \"spheres\": [{}{}{}],\n{}      \"groups\": [\n{}\n      ]\n    }}",
                       json_text(link.link), spheres.empty() ? "" : "\n", fmt::join(spheres, ",\n"),
                       spheres.empty() ? "" : "\n      ", elements, fmt::join(groups, ",\n"));
}

} // namespace

/// Returns what the proof is of: solids, or the surfaces of some links alone; empty where nothing is proved to be covered.
static std::string covers_member(const ProvedLinks& verdict) {
    if (verdict.guarantee != Guarantee::outer || verdict.proved == 0) {
        return "";
    }
    if (verdict.as_surface.empty()) {
        return "  \"covers\": \"solid\",\n";
    }
    std::vector<std::string> links;
    for (const ProvedLinks::LeftOut& link : verdict.as_surface) {
        links.push_back(json_text(link.link));
    }
    return fmt::format("  \"covers\": \"surface\",\n  \"surface_links\": [{}],\n  \"missing\": {},\n", fmt::join(links, ", "),
                       std::isfinite(verdict.missing) ? json_number(verdict.missing) : "null");
}

std::string write_links_layout(const SphereModel& model) {
    require_writable(model);
    std::vector<std::string> links;
    int version = 1;
    for (const LinkSpheres& link : elements_by_link(model)) {
        links.push_back(link_member(link, model));
        version = link.elements.are_spheres() ? version : 2;
    }
    std::vector<std::string> uncovered;
    for (const std::string& link : uncovered_links(model)) {
        uncovered.push_back(json_text(link));
    }
    return fmt::format(
        "{{\n  \"foam_spheres\": {},\n  \"name\": {},\n  \"robot\": {},\n  \"guarantee\": \"{}\",\n"
        "  \"certified\": {},\n{}{}{}  \"units\": \"m\",\n  \"frame\": \"link\",\n  \"links\": {{\n{}\n  }}\n}}\n",
        version, json_text(model.name), json_text(model.robot ? model.robot->name : ""),
        guarantee_text(model.guarantee), model.verdict.all(),
        model.verdict.geometry == CoveredGeometry::collision
            ? ""
            : fmt::format("  \"geometry\": \"{}\",\n",
                          words_of_covered_geometry()[static_cast<std::size_t>(model.verdict.geometry)]),
        covers_member(model.verdict),
        uncovered.empty() ? "" : fmt::format("  \"uncovered_links\": [{}],\n", fmt::join(uncovered, ", ")),
        fmt::join(links, ",\n"));
}

ElementsByLink read_links_layout(const Json& document) {
    const Json& version = document.at("foam_spheres");
    if (version != 1 && version != 2) {
        throw Error(ErrorCode::output, "JSON: foam_spheres is neither 1 nor 2: another version of the format");
    }
    if (document.at("units") != "m" || document.at("frame") != "link") {
        throw Error(ErrorCode::output, "JSON: the units are not 'm', or the frame is not 'link'");
    }
    ElementsByLink result;
    for (const auto& [name, link] : document.at("links").items()) {
        for (const Json& s : link.at("spheres")) {
            result[name].add(
                Sphere{{s.at(0).get<double>(), s.at(1).get<double>(), s.at(2).get<double>()}, s.at(3).get<double>()});
        }
        for (const Json& element : link.value("elements", Json::array())) {
            result[name].add(read_element(element));
        }
    }
    return result;
}

} // namespace foam
