// A JSON value and where it stands, so that messages can say it.
#pragma once

#include "text.hpp"

#include <nlohmann/json.hpp>

namespace foam::load_mesh {

/// A value of a JSON document and its path from the root, e.g. "meshes[0].primitives[2].indices". Refers to both.
class JsonPlace {
public:
    JsonPlace(const Source& source, const nlohmann::json& root) : source_(&source), value_(&root) {}

    const std::string& path() const { return path_; }
    /// Error(input) "FILE: PATH what; remedy: …".
    Error error(std::string_view what) const;

    /// The member of an object; empty if there is none or this is no object.
    std::optional<JsonPlace> find(std::string_view key) const;
    JsonPlace at(std::string_view key) const;
    /// Items of an array; 0 if this is none.
    std::size_t size() const { return value_->is_array() ? value_->size() : 0; }
    JsonPlace operator[](std::size_t index) const;
    /// This is an index into list `key` of `root`: the item that it means.
    JsonPlace target(const JsonPlace& root, std::string_view key) const;

    std::uint64_t natural() const;
    double number() const;
    /// An array of that many numbers.
    std::vector<double> numbers(std::size_t count) const;
    /// Empty if this is no text.
    std::string text() const { return value_->is_string() ? value_->get<std::string>() : std::string(); }

    std::uint64_t natural(std::string_view key, std::uint64_t otherwise) const;
    /// False if there is no such member.
    bool flag(std::string_view key) const;
    /// Whether it is the same value of the same document.
    bool operator==(const JsonPlace& other) const { return value_ == other.value_; }

private:
    const Source* source_;
    const nlohmann::json* value_;
    std::string path_;
};

} // namespace foam::load_mesh
