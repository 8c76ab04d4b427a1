// References to files in the rest of a URDF.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>
#include <foam/xml/document.hpp>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {

/// The file name of a <mesh> or <texture>.
struct Reference {
    std::string path; ///< as written
    xml::Span span;   ///< of the attribute's value in the text
};

/// Returns all of them in the order of the text, except those in the <collision> elements of the links `replaced`.
std::vector<Reference> references_of(std::string_view text, const xml::Element& robot,
                                     const std::set<std::string>& replaced);

/// What becomes of references in another file, and what is to be said of them.
struct MovedReferences {
    std::vector<Reference> moved; ///< with their new paths
    std::vector<std::pair<Severity, std::string>> messages;
};

/// Returns the references that change, as `mesh_paths` says: rewrite, keep, absolute or package.
MovedReferences moved_references(const std::vector<Reference>& references, const std::string& mesh_paths,
                                 const SphereModel& model);

/// Returns the reference to a file beside the one that is written, as `mesh_paths` says: relative, absolute or package.
/// `name`: relative to the folder of the written file. Logs where a package was asked for and there is none.
std::string uri_of_beside(const std::string& name, const std::string& mesh_paths, const SphereModel& model,
                          Context& context);

/// Returns the value for an attribute, in any quotes and in the encoding of the text.
std::string attribute_text(std::string_view value, std::string_view text);

} // namespace foam
