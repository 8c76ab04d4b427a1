// References to files in the rest of a URDF.
#pragma once

#include <foam/xml/document.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// A <mesh> or <texture> whose file name is a relative path.
struct RelativeReference {
    std::string path; ///< as written
    xml::Span span;   ///< of the attribute's value in the text
};

/// Returns all of them in the order of the text, except those in the <collision> elements of the links `replaced`.
std::vector<RelativeReference> relative_references(std::string_view text, const xml::Element& robot,
                                                   const std::set<std::string>& replaced);

/// Returns the path from `folder`, which need not exist yet, to the file that `path` refers to from `base`; an absolute
/// path if `folder` is empty. Returns `path` itself if it is right already; empty if there is no such file.
std::string reference_from(const std::filesystem::path& folder, const std::string& path,
                           const std::filesystem::path& base);

/// Returns the value for an attribute, in any quotes and in the encoding of the text.
std::string attribute_text(std::string_view value, std::string_view text);

} // namespace foam
