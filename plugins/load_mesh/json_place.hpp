// A JSON value with its place, for messages.
#pragma once

#include "text.hpp"

#include <nlohmann/json.hpp>

namespace foam::load_mesh {

/// A value of a JSON document and its path from the root, e.g. "meshes[0].primitives[2].indices". Refers to both.
class JsonPlace {
public:
    JsonPlace(const Source& source, const nlohmann::json& root) : source_(&source), value_(&root) {}

    const std::string& path() const { return path_; }
    /// Returns Error(input) "FILE: PATH what; remedy: …".
    Error error(std::string_view what) const;

    /// Returns the member of an object; empty if there is none or this is not an object.
    std::optional<JsonPlace> find(std::string_view key) const;
    JsonPlace at(std::string_view key) const;
    /// Returns the number of items of an array; 0 if this is not one.
    std::size_t size() const { return value_->is_array() ? value_->size() : 0; }
    JsonPlace operator[](std::size_t index) const;
    /// Returns the item of list `key` of `root` at this index.
    JsonPlace target(const JsonPlace& root, std::string_view key) const;

    std::uint64_t natural() const;
    double number() const;
    /// Returns an array of that many numbers.
    std::vector<double> numbers(std::size_t count) const;
    /// Returns the text; empty if this is not a text.
    std::string text() const { return value_->is_string() ? value_->get<std::string>() : std::string(); }

    std::uint64_t natural(std::string_view key, std::uint64_t otherwise) const;
    /// Returns the flag; false if there is no such member.
    bool flag(std::string_view key) const;
    /// Returns whether it is the same value of the same document.
    bool operator==(const JsonPlace& other) const { return value_ == other.value_; }

private:
    const Source* source_;
    const nlohmann::json* value_;
    std::string path_;
};

} // namespace foam::load_mesh
