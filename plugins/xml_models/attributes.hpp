// Numbers and names in attributes of XML.
#pragma once

#include <foam/geometry/vector.hpp>
#include <foam/xml/document.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foam::xml_models {

/// Returns the numbers with blanks between them; each reads back to the same double.
std::string numbers_text(std::span<const double> numbers);
std::string vector_text(const Vec3& v);
/// Returns ` name="value"`, escaped.
std::string attribute_text(std::string_view name, std::string_view value);

/// Returns the numbers of an attribute. Throws Error(input) naming file and line if it is absent or holds something
/// else; `count`: their number, 0 for any number but none.
std::vector<double> numbers_of(const xml::Element& element, std::string_view attribute, std::size_t count,
                               const std::string& file);
/// Returns an attribute's text. Throws Error(input) if it is absent.
const std::string& required(const xml::Element& element, std::string_view attribute, const std::string& file);

/// Returns a comment line with the text; empty for an empty text.
std::string comment_text(std::string_view text);

} // namespace foam::xml_models
