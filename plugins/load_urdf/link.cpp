#include "reader.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::urdf {
namespace {

template <std::size_t count>
std::array<double, count> numbers(const xml::Element& element, const char* attribute, const Reader& reader) {
    const std::string* text = element.attribute(attribute);
    if (!text || text->empty()) {
        reader.fail(element, fmt::format("<{0}> has no {1}; remedy: add {1}=\"…\"", element.name, attribute));
    }
    std::array<double, count> result{};
    std::size_t found = 0;
    for (const std::string_view word : words(*text)) {
        const std::optional<double> number = parse_number(word);
        if (!number) {
            reader.fail(element, fmt::format("{} of <{}>: '{}' is not a finite number", attribute, element.name, word));
        }
        result[std::min(found++, count - 1)] = *number;
    }
    if (found != count) {
        reader.fail(element, fmt::format("{} of <{}> holds {} numbers, not {}", attribute, element.name, found, count));
    }
    return result;
}

Pose read_origin(const xml::Element& origin, const Reader& reader) {
    const auto triple = [&](const char* name) {
        const auto v = origin.attribute(name) ? numbers<3>(origin, name, reader) : std::array<double, 3>{};
        return Vec3{v[0], v[1], v[2]};
    };
    const Vec3 xyz = triple("xyz");
    return Pose::from_xyz_rpy(xyz, triple("rpy"));
}

/// Returns the mass properties as written. What cannot be read is no error here: most users of a robot need no mass.
Inertial read_inertial(const xml::Element& element, const Reader& reader) {
    Inertial inertial;
    inertial.line = element.line;
    const xml::Element* mass = element.child("mass");
    const xml::Element* inertia = element.child("inertia");
    const xml::Element* origin = element.child("origin");
    if (!mass || !inertia) {
        return inertial;
    }
    try {
        inertial.origin = origin ? read_origin(*origin, reader) : Pose{};
        std::array<double, 6> moments{};
        constexpr std::array<std::pair<const char*, std::size_t>, 6> order{
            {{"ixx", 0}, {"ixy", 3}, {"ixz", 4}, {"iyy", 1}, {"iyz", 5}, {"izz", 2}}};
        for (const auto& [name, at] : order) {
            moments[at] = numbers<1>(*inertia, name, reader)[0];
        }
        inertial.mass = numbers<1>(*mass, "value", reader)[0];
        inertial.moments = moments;
    } catch (const Error& error) {
        inertial.problem = error.what();
    }
    return inertial;
}

/// Returns red, green, blue and opacity, which is 1 if absent; nothing if it is no colour.
std::optional<std::array<double, 4>> read_colour(const std::string& text) {
    std::vector<std::string_view> parts = words(text);
    if (parts.size() == 3) {
        parts.emplace_back("1");
    }
    std::array<double, 4> rgba{};
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const std::optional<double> share = i < parts.size() ? parse_number(parts[i]) : std::nullopt;
        if (!share) {
            return std::nullopt;
        }
        rgba[i] = *share;
    }
    return rgba;
}

Material read_material(const xml::Element& material) {
    const auto text = [](const xml::Element* element, const char* attribute) {
        const std::string* found = element ? element->attribute(attribute) : nullptr;
        return found ? *found : "";
    };
    return {.name = text(&material, "name"),
            .rgba = read_colour(text(material.child("color"), "rgba")),
            .texture = text(material.child("texture"), "filename")};
}

/// Adds what a material lacks from one of the same name.
void complete(Material& material, const Material& other) {
    if (material.texture.empty() && !material.rgba) { // a colour of its own stands in place of a texture
        material.texture = other.texture;
    }
    if (!material.rgba) {
        material.rgba = other.rgba;
    }
}

/// Returns the material of a <visual>, with the colour or texture that its name has elsewhere if it has none.
std::shared_ptr<const Material> material_of(const xml::Element& visual, const std::map<std::string, Material>& named) {
    const xml::Element* element = visual.child("material");
    if (!element) {
        return nullptr;
    }
    auto material = std::make_shared<Material>(read_material(*element));
    if (const auto known = named.find(material->name); known != named.end()) {
        complete(*material, known->second);
    }
    return material;
}

} // namespace

std::map<std::string, Material> materials_by_name(const xml::Element& root) {
    std::map<std::string, Material> named;
    const auto remember = [&](const xml::Element* element) {
        if (element && element->attribute("name")) {
            const Material material = read_material(*element);
            complete(named[material.name], material);
        }
    };
    for (const xml::Element* material : root.children_named("material")) {
        remember(material);
    }
    for (const xml::Element* link : root.children_named("link")) {
        for (const xml::Element* visual : link->children_named("visual")) {
            remember(visual->child("material"));
        }
    }
    return named;
}

Link read_link(const xml::Element& element, const std::map<std::string, Material>& materials, const Reader& reader,
               Context& context) {
    Link link{.name = reader.required(element, "name"), .collisions = {}, .visuals = {}};
    if (const xml::Element* inertial = element.child("inertial")) {
        link.inertial = read_inertial(*inertial, reader);
    }
    CancellationCounter asking(256);
    for (const xml::Element* collision : element.children_named("collision")) {
        asking.check();
        if (auto read = read_geometry_element(*collision, reader)) {
            link.collisions.push_back(std::move(*read));
        }
    }
    for (const xml::Element* visual : element.children_named("visual")) {
        try {
            if (auto read = read_geometry_element(*visual, reader)) {
                link.visuals.push_back(std::move(*read));
                link.visuals.back().material = material_of(*visual, materials);
            }
        } catch (const Error& error) {
            context.log(Severity::warning, fmt::format("a visual is left out of pictures: {}", error.what()));
        }
    }
    return link;
}

} // namespace foam::urdf
