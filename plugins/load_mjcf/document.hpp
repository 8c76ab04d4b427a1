// The elements of an MJCF, with those of the files that it includes in their places.
#pragma once

#include <foam/xml/document.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace foam::mjcf {

/// A file that was read.
struct File {
    std::filesystem::path path;
    std::unique_ptr<const xml::Element> root;
};

/// An element of one of the files. It has the children of the element; those of an included file stand in place of
/// their <include>.
struct Node {
    const xml::Element* element = nullptr;
    const File* file = nullptr;
    std::vector<Node> children{};

    const std::string& name() const { return element->name; }
    /// Returns the attribute; nullptr if there is none.
    const std::string* attribute(std::string_view key) const { return element->attribute(key); }
    std::vector<const Node*> children_named(std::string_view child_name) const;
    /// Returns "file:line".
    std::string place() const;
    /// Throws Error(input) "file:line: what".
    [[noreturn]] void fail(const std::string& what) const;
    /// Returns the attribute's text. Fails if it is absent or empty.
    const std::string& required(std::string_view key) const;
};

/// Returns the path that a reference states; MuJoCo takes both kinds of slashes.
std::filesystem::path path_of(std::string reference);

/// Returns the bytes of a file that an MJCF names, of at most `most`. Throws Error(input) for one that cannot be read.
std::string bytes_of(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large);
/// Returns the text of an MJCF that another one names. Errors as bytes_of().
std::string text_of(const std::filesystem::path& file);

/// An MJCF and the files that it includes. Nodes point into it.
class Document {
public:
    /// Reads the included files. Throws Error(input) for text that is no MJCF, and files that cannot be read.
    Document(const std::string& text, const std::filesystem::path& file);

    const Node& root() const { return root_; }
    /// Returns the folder of the main file.
    std::filesystem::path folder() const { return files_.front()->path.parent_path(); }
    /// Returns its files, the main one first.
    std::vector<std::filesystem::path> files() const;

private:
    const File& add(const std::string& text, const std::filesystem::path& file);
    void expand(Node& node);
    void include(const Node& place, std::vector<Node>& into);

    std::vector<std::unique_ptr<const File>> files_;
    std::set<std::filesystem::path> included_;
    Node root_;
};

} // namespace foam::mjcf
