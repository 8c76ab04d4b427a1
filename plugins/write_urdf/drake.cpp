#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <map>

namespace foam {
namespace {

constexpr const char* drake_namespace = "http://drake.mit.edu";

/// Returns the name of the group that is only this link.
std::string group_of_link(const SphereUrdf& urdf, const std::string& link) {
    return urdf.attribute_text("foam_" + link);
}

} // namespace

void declare_drake(SphereUrdf& urdf) {
    const std::string* declared = urdf.root().attribute("xmlns:drake");
    if (declared && *declared != drake_namespace) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: xmlns:drake is '{}', which Drake does not read; remedy: xmlns:drake=\"{}\"",
                                urdf.place_of(urdf.root()), shown(*declared), drake_namespace));
    }
    if (!declared) {
        urdf.editor().set_attribute(urdf.root(), "xmlns:drake", drake_namespace);
    }
}

void add_collision_filter_groups(SphereUrdf& urdf, Context& context) {
    warn_without_pairs(urdf.model(), context);
    if (!urdf.model().ignored_pairs) {
        return;
    }
    std::map<std::string, std::vector<std::string>> ignored; // a group that is named has to exist
    for (const IgnoredPair& pair : *urdf.model().ignored_pairs) {
        ignored[pair.first].push_back(pair.second);
        ignored.try_emplace(pair.second);
    }
    for (const Link& link : urdf.model().robot->links) {
        const auto others = ignored.find(link.name);
        if (others == ignored.end()) {
            continue;
        }
        std::string group = fmt::format("<drake:collision_filter_group name=\"{}\"><drake:member link=\"{}\"/>",
                                        group_of_link(urdf, link.name), urdf.attribute_text(link.name));
        for (const std::string& other : others->second) {
            group += fmt::format("<drake:ignored_collision_filter_group name=\"{}\"/>", group_of_link(urdf, other));
        }
        urdf.editor().append_child(urdf.root(), group + "</drake:collision_filter_group>");
    }
}

std::string proximity_properties(double mu_static, double mesh_resolution_hint) {
    std::string properties;
    for (const auto& [name, value] :
         {std::pair("mu_static", mu_static), std::pair("mesh_resolution_hint", mesh_resolution_hint)}) {
        properties += value > 0 ? fmt::format("<drake:{} value=\"{}\"/>", name, number_text(value)) : "";
    }
    return properties.empty() ? "" : "<drake:proximity_properties>" + properties + "</drake:proximity_properties>";
}

} // namespace foam
