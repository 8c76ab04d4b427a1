// Replacement of values in a YAML text whose other bytes stay as they are.
#pragma once

#include <foam/base/error.hpp>
#include <foam/yaml/value.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] yaml {

/// A YAML text that is edited.
class Splice {
public:
    /// Parses the text. `name`: of the file. Throws Error(code) with its place for a text that is no YAML map.
    Splice(std::string text, std::string name, ErrorCode code);

    const Value& root() const { return root_; }
    const std::string& text() const { return text_; }
    /// Returns the value at a path of keys; nullptr if there is none.
    const Value* find(const std::vector<std::string_view>& path) const;
    /// Replaces the value at a path of keys; adds the last key if only it is missing. A value on the line of its key,
    /// or within brackets, is replaced by one on one line. Comments within the replaced value go with it. Throws
    /// Error(code) with the place of what cannot be replaced.
    void set(const std::vector<std::string_view>& path, const Value& value);
    /// Appends items to the list at a path of keys, whose own bytes stay; adds the last key if only it is missing.
    /// Throws Error(code) with the place of what is no list.
    void extend(const std::vector<std::string_view>& path, const Value& items);

private:
    void parse();
    [[noreturn]] void fail(const Place& where, const std::string& what) const;
    std::size_t offset_of(const Place& place) const;
    std::size_t end_of_flow(std::size_t begin, const Place& where) const;
    std::size_t end_of_block(std::size_t line_after_key, std::size_t column, bool list) const;
    void replace(const Value& map, std::size_t index, const Value& value, bool in_flow);
    void add(const Value& map, std::string_view key, const Value& value);
    void append_in_flow(const Value& collection, const std::string& item);

    std::string text_, name_;
    ErrorCode code_;
    Value root_;
};

} // namespace yaml
} // namespace foam
