// The links of an SDF text, and what it says of their collisions.
#pragma once

#include <foam/xml/document.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam::sdf {

/// Returns the links of all models in the text, with their names: those of models in models begin with theirs, as
/// "inner::link"; where the file has more than one <model> or <include>, all begin with that of their model. `file`: its
/// name. Throws Error(input) for a text without models, and for elements without names.
std::vector<std::pair<std::string, const xml::Element*>> links_of(const xml::Element& root, const std::string& file);

/// Returns the text between the tags of an element.
std::string_view content_of(const xml::Element& element, std::string_view text);

/// Returns whether a collision takes part in no contact: its mask has no bit.
bool is_masked(const xml::Element& collision, std::string_view text);

} // namespace foam::sdf
