#include "collada.hpp"

#include "part.hpp"

#include <array>

namespace foam::load_mesh {
namespace {

using xml::Element;

/// Returns the first descendant of that name, with few levels in between; nullptr if there is none.
const Element* below(const Element& element, std::string_view name, int depth = 4) {
    for (const auto& child : element.children) {
        if (child->name == name) {
            return child.get();
        }
        if (const Element* found = depth > 0 ? below(*child, name, depth - 1) : nullptr) {
            return found;
        }
    }
    return nullptr;
}

/// Returns the <color> of <diffuse>, or of <emission> where that is all there is; 0 if there is none.
std::uint32_t colour_of_effect(const ColladaDocument& document, const Element& effect) try {
    const Element* technique = below(effect, "technique");
    for (const char* part : {"diffuse", "emission"}) {
        const Element* found = technique ? below(*technique, part) : nullptr;
        if (!found) {
            continue;
        }
        const Element* colour = found->child("color");
        if (!colour) {
            return 0; // a texture: what such a surface emits, mostly 0 0 0, is not its colour
        }
        std::array<double, 4> shares{0, 0, 0, 1};
        ElementWords words(document.source(), *colour);
        for (double& share : shares) {
            share = words.number().value_or(share);
        }
        return colour_number(shares);
    }
    return 0;
} catch (const Error&) {
    return 0; // a colour that is no numbers: the mesh is read without it
}

} // namespace

std::vector<std::uint32_t> colours_of(const ColladaDocument& document, const Element& instance,
                                      const std::vector<std::string>& names) {
    std::vector<std::uint32_t> colours(names.size());
    const Element* binding = instance.child("bind_material");
    const Element* technique = binding ? binding->child("technique_common") : nullptr;
    for (const Element* bound :
         technique ? technique->children_named("instance_material") : std::vector<const Element*>{}) {
        const std::string* symbol = bound->attribute("symbol");
        const Element* material = document.target(*bound, "target");
        const Element* use = material ? material->child("instance_effect") : nullptr;
        const Element* effect = use ? document.target(*use, "url") : nullptr;
        for (std::size_t i = 0; symbol && effect && i < names.size(); ++i) {
            if (names[i] == *symbol) {
                colours[i] = colour_of_effect(document, *effect);
            }
        }
    }
    return colours;
}

} // namespace foam::load_mesh
