// A COLLADA text as its elements, found by id, and the lists of numbers that they hold.
#pragma once

#include "text.hpp"

#include <xml/document.hpp>

#include <memory>
#include <unordered_map>

namespace foam::load_mesh {

class ColladaDocument {
public:
    /// Throws Error(input) for what is no XML or no COLLADA. Bytes that are no UTF-8 count as '?'.
    explicit ColladaDocument(const Source& source);

    const Source& source() const { return source_; }
    const xml::Element& root() const { return *root_; }
    /// The element that attribute `key` of `from` refers to ("#id"); nullptr if there is none.
    const xml::Element* target(const xml::Element& from, std::string_view key) const;
    /// Error(input) "FILE:LINE: what", at the element's start.
    Error error(const xml::Element& element, std::string_view what) const;

private:
    void index(const xml::Element& element);

    const Source& source_;
    std::unique_ptr<const xml::Element> root_;
    std::unordered_map<std::string_view, const xml::Element*> ids_;
};

/// The words between an element's tags, comments left out.
class ElementWords {
public:
    ElementWords(const Source& source, const xml::Element& element);

    /// Empty at the end.
    std::string_view next();
    /// Line of the last word.
    std::size_t line() const { return words_.line(); }
    /// "FILE:LINE: what", at the last word.
    Error error(std::string_view what) const;
    /// The next word as a coordinate or as an index (a natural number below 2^32); empty at the end, an error if it is
    /// none.
    std::optional<double> number();
    std::optional<std::uint32_t> index();

private:
    const Source& source_;
    const xml::Element& element_;
    Words words_;
};

} // namespace foam::load_mesh
