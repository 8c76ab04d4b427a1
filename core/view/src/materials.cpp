#include "materials.hpp"

#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace foam::inline view {
namespace {

/// Returns the colour of <color rgba="1 0.5 0 1"/> in a <material>.
std::optional<Colour> colour_in(const xml::Element& material) {
    const xml::Element* element = material.child("color");
    const std::string* text = element ? element->attribute("rgba") : nullptr;
    if (!text) {
        return std::nullopt;
    }
    Colour colour = 0;
    const std::vector<std::string_view> parts = words(*text);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::optional<double> share = i < parts.size() ? parse_number(parts[i])
                                            : i == 3         ? std::optional(1.0)
                                                             : std::nullopt;
        if (!share) {
            return std::nullopt;
        }
        colour = colour << 8 | static_cast<Colour>(std::lround(255 * std::clamp(*share, 0.0, 1.0)));
    }
    return colour;
}

/// Returns the <visual> elements of the robot's elements, which may be fewer: those in the same lines.
std::vector<const xml::Element*> visuals_of(const xml::Element& link, const std::vector<GeometryElement>& visuals) {
    std::vector<const xml::Element*> all = link.children_named("visual"), result;
    if (all.size() == visuals.size()) {
        return all;
    }
    for (const GeometryElement& visual : visuals) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const xml::Element* e) { return e->line == visual.line; });
        result.push_back(found == all.end() ? nullptr : *found);
    }
    return result;
}

} // namespace

std::vector<std::vector<std::optional<Colour>>> material_colours(const Robot& robot) {
    std::vector<std::vector<std::optional<Colour>>> result(robot.links.size());
    for (std::size_t l = 0; l < robot.links.size(); ++l) {
        result[l].resize(robot.links[l].visuals.size());
    }
    if (robot.source.empty()) {
        return result;
    }
    const auto root = xml::parse(robot.source, robot.file.string(), ErrorCode::input);
    std::map<std::string, Colour> named;
    const auto remember = [&](const xml::Element& material) {
        const std::string* name = material.attribute("name");
        const std::optional<Colour> colour = colour_in(material);
        if (name && colour) {
            named.emplace(*name, *colour);
        }
    };
    for (const xml::Element* material : root->children_named("material")) {
        remember(*material);
    }
    const auto links = root->children_named("link");
    for (const xml::Element* link : links) { // the name of a material may be used in links before its colour
        for (const xml::Element* visual : link->children_named("visual")) {
            if (const xml::Element* material = visual->child("material")) {
                remember(*material);
            }
        }
    }
    for (std::size_t l = 0; l < std::min(links.size(), robot.links.size()); ++l) {
        const auto visuals = visuals_of(*links[l], robot.links[l].visuals);
        for (std::size_t v = 0; v < visuals.size(); ++v) {
            const xml::Element* material = visuals[v] ? visuals[v]->child("material") : nullptr;
            if (!material) {
                continue;
            }
            result[l][v] = colour_in(*material);
            const std::string* name = material->attribute("name");
            if (const auto known = named.find(name ? *name : ""); !result[l][v] && known != named.end()) {
                result[l][v] = known->second;
            }
        }
    }
    return result;
}

} // namespace foam::inline view
