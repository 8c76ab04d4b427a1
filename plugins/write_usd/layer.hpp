// Layers of USD as text (.usda) that put spheres and other elements over the links of another layer.
#pragma once

#include <foam/sdk/elements.hpp>

#include <string>
#include <string_view>

namespace foam::usd {

/// Parameters of write.usd.
struct LayerOptions {
    std::string prim = "/{robot}/{link}"; ///< path of a link's prim
    std::string sublayer;                 ///< layer below this one; empty: none
    std::string inactive;                 ///< child of each link's prim that is switched off; empty: none
    bool pairs = true;                    ///< write pairs of links that need no check
    KnownKinds known{};
};

/// Returns the layer of a model. Throws Error(output) for options that no layer can hold.
std::string layer_text(const SphereModel& model, const LayerOptions& options);

/// Returns whether a text is a layer; its first line is a comment, and may be missing.
bool is_layer(std::string_view text);
/// Returns the elements of a layer of layer_text(), by link. Throws Error(input) naming file, line and reason.
SphereFile read_layer(std::string_view text, const std::filesystem::path& file);

} // namespace foam::usd
