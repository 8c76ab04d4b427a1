// References to files in what stays of a URDF.
#pragma once

#include <xml/document.hpp>

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

/// All of them in the order of the text, but for those in the <collision> elements of the links `replaced`.
std::vector<RelativeReference> relative_references(std::string_view text, const xml::Element& robot,
                                                   const std::set<std::string>& replaced);

/// What leads from `folder`, which need not exist yet, to where `path` leads from `base`; an absolute path if `folder`
/// is empty. `path` itself if it leads there as it is; empty if it leads to no file.
std::string reference_from(const std::filesystem::path& folder, const std::string& path,
                           const std::filesystem::path& base);

/// As it may stand in an attribute, in whatever quotes and encoding the text has.
std::string attribute_text(std::string_view value, std::string_view text);

} // namespace foam
