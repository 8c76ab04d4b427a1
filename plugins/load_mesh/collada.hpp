// COLLADA: the document, its geometry, nodes and colours.
#pragma once

#include "part.hpp"
#include "text.hpp"

#include <foam/xml/document.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace foam::load_mesh {

class ColladaDocument {
public:
    /// Parses the text. Throws Error(input) if it is not XML or not COLLADA. Bytes that are not UTF-8 count as '?'.
    explicit ColladaDocument(const Source& source);

    const Source& source() const { return source_; }
    const xml::Element& root() const { return *root_; }
    /// Returns the element that attribute `key` of `from` refers to ("#id"); nullptr if there is none.
    const xml::Element* target(const xml::Element& from, std::string_view key) const;
    /// Returns Error(input) "FILE:LINE: what", at the element's start.
    Error error(const xml::Element& element, std::string_view what) const;

private:
    void index(const xml::Element& element);

    const Source& source_;
    std::unique_ptr<const xml::Element> root_;
    std::unordered_map<std::string_view, const xml::Element*> ids_;
};

/// The words between an element's tags, without comments.
class ElementWords {
public:
    ElementWords(const Source& source, const xml::Element& element);

    /// Returns the next word; empty at the end.
    std::string_view next();
    /// Returns the line of the last word.
    std::size_t line() const { return words_.line(); }
    /// Returns the error "FILE:LINE: what", at the last word.
    Error error(std::string_view what) const;
    /// Returns the next word as a coordinate or as an index (a natural number below 2^32). Empty at the end. Throws if
    /// the word is not one.
    std::optional<double> number();
    std::optional<std::uint32_t> index();

private:
    const Source& source_;
    const xml::Element& element_;
    Words words_;
};

/// Returns the diffuse colours, 0xRRGGBBAA, of materials that an <instance_geometry> or <instance_controller> binds to
/// names; 0 for one that is not bound, or has only a texture.
std::vector<std::uint32_t> colours_of(const ColladaDocument& document, const xml::Element& instance,
                                      const std::vector<std::string>& names);

/// A <geometry>: its part, and the names by which its materials are bound where it is shown.
struct ColladaGeometry {
    Part part;
    std::vector<std::string> materials; ///< Part::materials are indices into them
};

/// Returns the triangles, polygons, strips and fans of a <geometry>, in its frame and unit, without lines. Logs
/// surfaces that are left out (splines, holes) and suspicious contents.
ColladaGeometry read_geometry(const ColladaDocument& document, const xml::Element& geometry, Context& context);

/// Returns the product of the node's matrix, translate, rotate, scale, lookat and skew elements, in their order: from
/// the node's frame to its parent's, in the file's unit.
Affine transform_of(const ColladaDocument& document, const xml::Element& node);

} // namespace foam::load_mesh
